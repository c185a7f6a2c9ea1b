// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/vec.h"

#include <algorithm>
#include <cmath>

namespace halfspace::HS_LANES {

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!(largest > 0.0)) return glm::dvec3(0.0);
  int exponent = 0;
  std::frexp(largest, &exponent);
  const glm::dvec3 scaled(std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent));
  return scaled / std::sqrt(glm::dot(scaled, scaled));
}

}  // namespace halfspace::HS_LANES
