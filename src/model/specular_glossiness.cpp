// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/specular_glossiness.h"

#include <algorithm>
#include <cmath>

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

double brightness(const glm::dvec3& c) { return std::sqrt(0.299 * c.x * c.x + 0.587 * c.y * c.y + 0.114 * c.z * c.z); }

}  // namespace

MetallicColor metallic_color(const glm::dvec3& diffuse, const glm::dvec3& specular) {
  constexpr double kDielectric = kDielectricReflectance, kEpsilon = 1e-6;
  const double remaining = 1.0 - std::max({specular.x, specular.y, specular.z});
  const double s = brightness(specular);
  double metallic = 0.0;
  if (s >= kDielectric) {  // the positive solution of kDielectric·m² + b·m + c = 0
    const double b = brightness(diffuse) * remaining / (1.0 - kDielectric) + s - 2.0 * kDielectric, c = kDielectric - s;
    const double root = std::sqrt(std::max(b * b - 4.0 * kDielectric * c, 0.0));
    metallic = std::clamp((root - b) / (2.0 * kDielectric), 0.0, 1.0);
  }
  const glm::dvec3 from_diffuse = diffuse * (remaining / (1.0 - kDielectric) / std::max(1.0 - metallic, kEpsilon));
  const glm::dvec3 from_specular = (specular - kDielectric * (1.0 - metallic)) / std::max(metallic, kEpsilon);
  return {glm::clamp(glm::mix(from_diffuse, from_specular, metallic * metallic), 0.0, 1.0), metallic};
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
