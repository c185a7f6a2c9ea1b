// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/mesh_streams.h"

#include <array>

namespace halfspace::HS_LANES {

namespace {

constexpr std::array<float, 4> kZeros{0, 0, 0, 0}, kOnes{1, 1, 1, 1}, kTangent{1, 0, 0, 1};

// Returns the rows, or a row that is repeated for all vertices if there are none.
template <class T>
StreamOf<T> stream_or(std::span<const T> rows, const std::array<float, 4>& constant, std::size_t vertices) {
  if (!rows.empty()) return stream(rows);
  return {{.data = std::as_bytes(std::span(constant)).data(), .stride = 0, .components = T::length(), .count = vertices}};
}

}  // namespace

StreamOf<glm::vec2> uv_stream(std::span<const glm::vec2> uvs, std::size_t vertices) { return stream_or(uvs, kZeros, vertices); }

StreamOf<glm::vec3> MeshStreams::normal_stream() const { return stream_or(normals, kZeros, positions.size()); }
StreamOf<glm::vec4> MeshStreams::tangent_stream() const { return stream_or(tangents, kTangent, positions.size()); }
StreamOf<glm::vec4> MeshStreams::color_stream() const { return stream_or(colors, kOnes, positions.size()); }

}  // namespace halfspace::HS_LANES
