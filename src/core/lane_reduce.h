// SPDX-License-Identifier: Apache-2.0
//
// The smallest and the largest lane. Unlike sums, they do not depend on the order of the operations.
#pragma once

#include <utility>

#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

namespace detail {

/// Exchanges each lane with the one `distance` lanes away; distance: a power of two below W.
template <int distance, int W, int... I>
HS_INLINE RealN<W> exchanged(RealN<W> v, std::integer_sequence<int, I...>) {
  return RealN<W>(__builtin_shufflevector(v.v, v.v, (I ^ distance)...));
}

template <int distance, int W, class F>
HS_INLINE float reduced(RealN<W> v, const F& f) {
  if constexpr (distance == 0) {
    return lane(v, 0);
  } else {
    return reduced<distance / 2>(f(v, exchanged<distance>(v, std::make_integer_sequence<int, W>())), f);
  }
}

}  // namespace detail

/// Returns the smallest or largest lane. No lane may be NaN.
inline float min_lane(float v) { return v; }
inline float max_lane(float v) { return v; }
template <int W>
HS_INLINE float min_lane(RealN<W> v) {
  return detail::reduced<W / 2>(v, [](RealN<W> a, RealN<W> b) { return min(a, b); });
}
template <int W>
HS_INLINE float max_lane(RealN<W> v) {
  return detail::reduced<W / 2>(v, [](RealN<W> a, RealN<W> b) { return max(a, b); });
}

}  // namespace halfspace::HS_LANES
