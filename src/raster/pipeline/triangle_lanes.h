// SPDX-License-Identifier: Apache-2.0
//
// Triangles of W lanes, read out of their records.
#pragma once

#include <array>
#include <cstddef>

#include "halfspace/core/transpose.h"
#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace {

struct CornerLanes {
  std::array<Int, 3> x, y;
};

/// The corners of each lane's triangle. triangle(k): lane k's, a const Triangle*.
template <class F>
HS_INLINE CornerLanes load_corners(const F& triangle) {
  static_assert(offsetof(Triangle, x) == 0 && offsetof(Triangle, y) == 3 * sizeof(int32_t));
  const auto words_from = [&](std::size_t i) {
    return load_fours<Int>([&](int k) { return reinterpret_cast<const std::byte*>(triangle(k)) + i * sizeof(int32_t); });
  };
  const std::array<Int, 4> start = words_from(0), rest = words_from(2);
  return {{start[0], start[1], start[2]}, {start[3], rest[2], rest[3]}};
}

/// The vertices and the flags of each lane's triangle.
template <class F>
HS_INLINE std::array<Int, 4> load_vertices_and_flags(const F& triangle) {
  static_assert(offsetof(Triangle, flags) == offsetof(Triangle, vertex) + 3 * sizeof(int32_t));
  return load_fours<Int>([&](int k) { return reinterpret_cast<const std::byte*>(triangle(k)) + offsetof(Triangle, vertex); });
}

}  // namespace halfspace
