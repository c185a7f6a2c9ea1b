// SPDX-License-Identifier: Apache-2.0
//
// Helpers for the construction of textures and their mip levels.
#pragma once

#include "halfspace/core/parallel.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::HS_LANES::detail {

/// Four channels, processed at once.
using Channels = RealN<4>;

/// Clamps a linear value to the range of rgba32f texels.
inline Channels clamped_texel(const glm::vec4& v) {
  const auto x = load<Channels>(&v.x);
  return select(x == x, clamp(x, Channels(-kMaxTexel), Channels(kMaxTexel)), Channels(0.0f));
}

/// Returns the channels of an rgba16f texel.
inline IntN<4> half_channels(const glm::vec4& v) { return float_to_finite_half(clamped_texel(v)); }

/// Returns the width or height of the next level.
constexpr int half_size(int size) { return size <= 2 ? 1 : size / 2; }

/// Calls f(row) for every row, using the workers if there are any.
template <class F>
void for_each_row(const Workers* workers, int rows, const F& f) {
  if (workers != nullptr && rows > 1) return workers->for_each(rows, f);
  for (int row = 0; row < rows; ++row) f(row);
}

}  // namespace halfspace::HS_LANES::detail
