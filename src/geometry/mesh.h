// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Indexed triangle list, counter-clockwise when seen from the front. Every non-empty stream has one entry per vertex. Normals have
/// unit length. `tangents` may be empty. Otherwise xyz points along increasing u, and cross(normal, xyz)·w along decreasing v (v =
/// 0 is the top row of a texture), so green is up in normal maps.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> uvs;
  std::vector<uint32_t> indices;
};

}  // namespace halfspace::HS_LANES
