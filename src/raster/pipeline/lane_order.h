// SPDX-License-Identifier: Apache-2.0
//
// The three vertices of W triangles, put in order lane by lane.
#pragma once

#include <array>

#include "halfspace/core/lanes.h"

namespace halfspace {

template <class T>
HS_INLINE void swap_lanes(Mask m, T& a, T& b) {
  const T from = a;
  a = select(m, b, from);
  b = select(m, from, b);
}

/// Moves v[1] (where one) or v[2] (where two) to the front, going round. No lane is set in both.
template <class T>
HS_INLINE void rotate_lanes(Mask one, Mask two, std::array<T, 3>& v) {
  const std::array<T, 3> from = v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = select(two, from[(i + 2) % 3], select(one, from[(i + 1) % 3], from[i]));
}

}  // namespace halfspace
