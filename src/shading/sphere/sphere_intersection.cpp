// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/sphere/sphere_intersection.h"

#include <cmath>

namespace halfspace::HS_LANES {

namespace {

double whole(const SplitDouble& d) { return static_cast<double>(d.high) + static_cast<double>(d.low); }

}  // namespace

// Returns a·r² − |e × d|², which is the term under the root at the point closest to the center.
double SphereIntersection::root_in_double(const glm::vec3& center_cs, float radius, float x, float y) const {
  const glm::dvec3 c(center_cs);
  const double px = std::fma(static_cast<double>(x), whole(ray_x.scale), whole(ray_x.bias));
  const double py = std::fma(static_cast<double>(y), whole(ray_y.scale), whole(ray_y.bias)), r = static_cast<double>(radius);
  if (!perspective) return difference_of_products(r, r, px - c.x, px - c.x) - (py - c.y) * (py - c.y);
  const double ex = std::fma(px, c.z, -c.x), ey = std::fma(py, c.z, -c.y), twist = difference_of_products(ex, py, ey, px);
  return (px * px + py * py + 1.0) * r * r - (ex * ex + ey * ey + twist * twist);
}

}  // namespace halfspace::HS_LANES
