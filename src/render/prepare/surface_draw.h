// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// The vertex streams of a mesh that surface shaders can read. Not owned.
struct SurfaceStreams {
  std::span<const glm::vec3> positions, normals;
  std::span<const glm::vec4> tangents;
  std::span<const glm::vec2> uvs;
};

/// Returns the draw of a lit surface with the shader variant that has the minimum features it needs.
PreparedDraw surface_draw(const LitSurface& s, ShadingRate rate, NormalDetail detail, const SurfaceStreams& mesh,
                          const std::shared_ptr<const Indices>& indices);

}  // namespace halfspace::HS_LANES
