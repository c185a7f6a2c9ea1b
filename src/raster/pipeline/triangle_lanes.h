// SPDX-License-Identifier: Apache-2.0
//
// W triangles at a time: loads their data and reorders their vertices in each lane.
#pragma once

#include <array>
#include <cstddef>

#include "halfspace/core/transpose.h"
#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace::HS_LANES {

template <class T>
HS_INLINE void swap_lanes(Mask m, T& a, T& b) {
  const T from = a;
  a = select(m, b, from);
  b = select(m, from, b);
}

/// Rotates the elements so that v[1] (in lanes of `one`) or v[2] (in lanes of `two`) becomes the first. A lane must not be set in both
/// masks.
template <class T>
HS_INLINE void rotate_lanes(Mask one, Mask two, std::array<T, 3>& v) {
  const std::array<T, 3> from = v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = select(two, from[(i + 2) % 3], select(one, from[(i + 1) % 3], from[i]));
}

struct CornerLanes {
  std::array<Int, 3> x, y;
};

/// Loads the vertex positions of the triangle in each lane. triangle(k) returns a const Triangle* for lane k.
template <class F>
HS_INLINE CornerLanes load_corners(const F& triangle) {
  static_assert(offsetof(Triangle, x) == 0 && offsetof(Triangle, y) == 3 * sizeof(int32_t));
  const auto words_from = [&](std::size_t i) {
    return load_aos4<Int>([&](int k) { return reinterpret_cast<const std::byte*>(triangle(k)) + i * sizeof(int32_t); });
  };
  const std::array<Int, 4> start = words_from(0), rest = words_from(2);
  return {{start[0], start[1], start[2]}, {start[3], rest[2], rest[3]}};
}

/// Loads the vertices and flags of the triangle in each lane.
template <class F>
HS_INLINE std::array<Int, 4> load_vertices_and_flags(const F& triangle) {
  static_assert(offsetof(Triangle, flags) == offsetof(Triangle, vertex) + 3 * sizeof(int32_t));
  return load_aos4<Int>([&](int k) { return reinterpret_cast<const std::byte*>(triangle(k)) + offsetof(Triangle, vertex); });
}

}  // namespace halfspace::HS_LANES
