// SPDX-License-Identifier: Apache-2.0
//
// What a clear between the draws of a pass sets.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "halfspace/raster/draw_state.h"

namespace halfspace::HS_LANES {

/// What Pass::clear() sets (glClear and glClearBuffer, OpenGL 4.6, section 17.4.3). Everything else keeps its contents.
struct ClearValues {
  std::optional<Rect> rect{};  ///< window coordinates, as DrawState::scissor; default: the whole target
  /// Colors of the attachments: linear, straight alpha; for integer formats, integers stored with std::bit_cast.
  std::array<std::optional<glm::vec4>, kMaxColorTargets> colors{};
  ColorMask mask{};
  std::optional<float> depth{};  ///< in [0, 1]
  std::optional<uint8_t> stencil{};
  uint8_t stencil_mask = 0xff;               ///< bits of the stencil that are written
  std::optional<DrawCondition> condition{};  ///< as DrawState::condition
};

}  // namespace halfspace::HS_LANES
