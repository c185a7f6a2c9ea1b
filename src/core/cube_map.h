// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns the direction through the point (s, t) of a cube map face, in cube map space. face is 0 to 5 for +x, −x, +y, −y,
/// +z, −z; s and t are in [−1, 1], and t points down. The direction is not normalized: its component along the axis of the
/// face is ±1.
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

}  // namespace halfspace::HS_LANES
