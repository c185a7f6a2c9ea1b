// SPDX-License-Identifier: Apache-2.0
//
// Random parts of a draw state.
#pragma once

#include "halfspace/raster/draw_state.h"
#include "support/random.h"

namespace halfspace {

/// Returns random blend equations and random factors from the first `factors` values of BlendFactor.
inline BlendState random_equations(Random& random, int factors) {
  const auto factor = [&] { return static_cast<BlendFactor>(random.below(factors)); };
  const auto equation = [&] { return static_cast<BlendEquation>(random.below(5)); };
  BlendState b;
  b.color_equation = equation();
  b.source_color = factor();
  b.destination_color = factor();
  b.alpha_equation = equation();
  b.source_alpha = factor();
  b.destination_alpha = factor();
  return b;
}

inline ColorMask random_mask(Random& random) { return {!random.once_in(3), !random.once_in(3), !random.once_in(3), !random.once_in(3)}; }

}  // namespace halfspace
