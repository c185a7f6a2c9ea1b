// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES::detail {

/// The texels along one axis that a texel of the next level averages, and their weights, which add up to 1.
template <class Number>
struct MipTaps {
  int first;
  int count;
  Number weight[3];
};

template <class Number>
constexpr MipTaps<Number> mip_taps(int size, int i) {
  if (size == 1) return {0, 1, {1}};
  if (size % 2 == 0) return {2 * i, 2, {Number(0.5f), Number(0.5f)}};
  const auto n = static_cast<Number>(size / 2), whole = static_cast<Number>(size), at = static_cast<Number>(i);
  return {2 * i, 3, {(n - at) / whole, n / whole, (at + 1) / whole}};
}

}  // namespace halfspace::HS_LANES::detail
