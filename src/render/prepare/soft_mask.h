// SPDX-License-Identifier: Apache-2.0
//
// Decides how a material uses its opacity if the format of its file does not say so (ModelMaterial::mask_unless_soft).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Returns the 8-bit value of a channel of a data texel.
inline uint8_t channel_value(const glm::u8vec4& texel, Channel channel) {
  switch (channel) {
    case Channel::red: return texel.x;
    case Channel::green: return texel.y;
    case Channel::blue: return texel.z;
    case Channel::alpha: return texel.w;
    case Channel::luminance: break;
  }
  // ITU-R BT.709. The values of data maps are linear.
  const float y = 0.2126f * static_cast<float>(texel.x) + 0.7152f * static_cast<float>(texel.y) + 0.0722f * static_cast<float>(texel.z);
  return static_cast<uint8_t>(y + 0.5f < 255.0f ? y + 0.5f : 255.0f);
}

/// Returns true if more than 5 % of the texels of an opacity map are between 10 % and 90 %. The antialiased edges of a mask are fewer.
/// texel(x, y) must return a glm::u8vec4.
template <class F>
bool is_soft(int width, int height, const F& texel, Channel channel) {
  int64_t between = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const uint8_t value = channel_value(texel(x, y), channel);
      between += value >= 26 && value <= 229 ? 1 : 0;
    }
  }
  return 20 * between > int64_t{width} * height;
}

}  // namespace halfspace::HS_LANES
