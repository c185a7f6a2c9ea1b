// SPDX-License-Identifier: Apache-2.0
//
// Bounds on the distance between two surfaces.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "halfspace/core/parallel.h"
#include "halfspace/model/detail/triangle_tree.h"

namespace halfspace::HS_LANES {

/// A list of triangles, all in range. Not owned.
struct TriangleList {
  std::span<const glm::vec3> positions;
  std::span<const uint32_t> indices;
};

/// Returns an upper bound on the distance from any point of `from` to the nearest point of `to`. It is usually at most 1.5 times the
/// largest distance of a vertex, or `resolution` if that is more; higher if `from` lies farther away inside of a triangle than at its
/// vertices, or if long triangles cross so many others that a limit on the work is reached. The same for any number of threads.
double distance_bound(const TriangleList& from, const TriangleTree& to, double resolution, const Workers& workers);

}  // namespace halfspace::HS_LANES
