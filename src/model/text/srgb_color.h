// SPDX-License-Identifier: Apache-2.0
//
// Colors of model files that are sRGB-encoded but not stored as 8-bit values.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "halfspace/core/srgb.h"

namespace halfspace::HS_LANES {

/// Returns the linear value of an sRGB-encoded value from 0 to 255, to which it is clamped. Values between two 8-bit values are
/// interpolated linearly; the error is below 7e-6.
inline float linear_from_srgb_code(float value) {
  const float code = std::clamp(value, 0.0f, 255.0f);
  const auto low = static_cast<std::size_t>(std::min(code, 254.0f));
  return kSrgbToLinear[low] + (code - static_cast<float>(low)) * (kSrgbToLinear[low + 1] - kSrgbToLinear[low]);
}

/// Like linear_from_srgb_code, for values from 0 to 1.
inline float linear_from_srgb(float encoded) { return linear_from_srgb_code(encoded * 255.0f); }

inline glm::vec3 linear_from_srgb(const glm::vec3& encoded) {
  return {linear_from_srgb(encoded.x), linear_from_srgb(encoded.y), linear_from_srgb(encoded.z)};
}

}  // namespace halfspace::HS_LANES
