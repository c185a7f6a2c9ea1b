// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "halfspace/core/vec.h"
#include "halfspace/raster/vertex_input.h"

namespace halfspace::HS_LANES {

/// Returns the rows, or `vertices` equal rows with the texture coordinates (0, 0) if there are none.
StreamOf<glm::vec2> uv_stream(std::span<const glm::vec2> uvs, std::size_t vertices);

/// The vertex values of a mesh, not owned. Those that it lacks are empty.
struct MeshStreams {
  std::span<const glm::vec3> positions, normals;
  std::span<const glm::vec4> tangents, colors;
  std::span<const glm::vec2> uvs, second_uvs;

  // Vertex streams. Values that the mesh lacks are the same for all vertices: a zero normal, the tangent (1, 0, 0) with a right-handed
  // bitangent, white, and the texture coordinates (0, 0). The second texture coordinates default to the first.
  StreamOf<glm::vec3> position_stream() const { return stream(positions); }
  StreamOf<glm::vec3> normal_stream() const;
  StreamOf<glm::vec4> tangent_stream() const;
  StreamOf<glm::vec4> color_stream() const;
  StreamOf<glm::vec2> uv_stream() const { return HS_LANES::uv_stream(uvs, positions.size()); }
  StreamOf<glm::vec2> second_uv_stream() const { return HS_LANES::uv_stream(second_uvs.empty() ? uvs : second_uvs, positions.size()); }
};

}  // namespace halfspace::HS_LANES
