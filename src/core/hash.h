// SPDX-License-Identifier: Apache-2.0
//
// Integer hash for procedural patterns, with identical results for int32_t and for lanes of any width.
#pragma once

#include <type_traits>

#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

/// Returns a·b modulo 2^32.
template <class I>
HS_INLINE I wrapping_mul(I a, int32_t b) {
  if constexpr (std::is_same_v<I, int32_t>) {
    return static_cast<int32_t>(static_cast<uint32_t>(a) * static_cast<uint32_t>(b));
  } else {
    return a * I(b);
  }
}

/// Hashes x so that every bit of the result depends on every bit of x. The multipliers are those of lowbias32, from
/// C. Wellons' search for low-bias 32-bit hashes.
template <class I>
HS_INLINE I mix_bits(I x) {
  const auto shifted = [](I v, int n) { return (v >> n) & I(static_cast<int32_t>(0xffffffffu >> n)); };  // logical shift
  x = wrapping_mul(x ^ shifted(x, 16), 0x7feb352d);
  x = wrapping_mul(x ^ shifted(x, 15), static_cast<int32_t>(0x846ca68bu));
  return x ^ shifted(x, 16);
}

/// Maps the top 24 bits of a hash to a number in [0, 1).
template <class R>
HS_INLINE R unit_fraction(IntOf<R> hash) {
  return to_real<R>((hash >> 8) & 0xffffff) * R(0x1p-24f);
}

}  // namespace halfspace::HS_LANES
