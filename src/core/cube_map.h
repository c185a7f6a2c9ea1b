// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace halfspace {

/// The direction in map space through (s, t) of a cube map's face. face: 0 … 5 for +x, −x, +y, −y, +z, −z; s and t in [−1, 1], t
/// downwards. The component along the face's axis is ±1; the direction is not normalized.
inline glm::dvec3 cube_direction(int face, double s, double t) {
  switch (face) {
    case 0: return {1, -t, -s};
    case 1: return {-1, -t, s};
    case 2: return {s, 1, t};
    case 3: return {s, -1, -t};
    case 4: return {s, -t, 1};
    default: return {-s, -t, -1};
  }
}

}  // namespace halfspace
