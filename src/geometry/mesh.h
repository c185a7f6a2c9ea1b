// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace halfspace {

/// A triangle list with shared vertices: three indices a triangle, counter-clockwise seen from the front. Every
/// stream that is present has one entry per vertex; normals have unit length. `tangents` may be empty: xyz points
/// along increasing u, and cross(normal, xyz)·w along decreasing v (the top row of a texture is v = 0), so that
/// normal maps have green up.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> uvs;
  std::vector<uint32_t> indices;
};

}  // namespace halfspace
