// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/patch_grid.h"

#include <algorithm>
#include <bit>

#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kMaxGridLevel = 12;

// Returns false if `x` is outside of [0, n] and the axis is not closed.
bool wrap_axis(int& x, int n, bool closed) {
  if (!closed) return x >= 0 && x <= n;
  if (x < 0) x += n;
  if (x >= n) x -= n;
  return true;
}

}  // namespace

GridVertices::GridVertices(const PatchGrid& grid, int level) : grid_(grid), level_(level), bits_(static_cast<std::size_t>(grid.patches())) {
  HS_CHECK_OP(level, <=, kMaxGridLevel, "GridVertices: the level is too high; expected at most 12");
}

bool GridVertices::wrap(GridVertex& v) const {
  return wrap_axis(v.i, grid_.columns << level_, grid_.closed_u) && wrap_axis(v.j, grid_.rows << level_, grid_.closed_v);
}

GridVertices::Bit GridVertices::bit_of(GridVertex v) const {
  const int column = std::min(v.i >> level_, grid_.columns - 1), row = std::min(v.j >> level_, grid_.rows - 1);
  const int i = v.i - (column << level_), j = v.j - (row << level_);
  return {row * grid_.columns + column, static_cast<std::size_t>(j) * ((std::size_t{1} << level_) + 1) + static_cast<std::size_t>(i)};
}

void GridVertices::add(int patch, GridVertex v) {
  add({((patch % grid_.columns) << level_) + v.i, ((patch / grid_.columns) << level_) + v.j});
}

void GridVertices::add(GridVertex v) {
  if (!wrap(v)) return;
  const int step = std::countr_zero(static_cast<unsigned>(v.i | v.j));
  if (step >= level_) return;  // a corner
  const Bit bit = bit_of(v);
  std::vector<uint64_t>& words = bits_[static_cast<std::size_t>(bit.patch)];
  if (words.empty()) {
    const std::size_t side = (std::size_t{1} << level_) + 1;
    words.resize((side * side + 63) / 64);
  }
  uint64_t& word = words[bit.index / 64];
  const uint64_t mask = uint64_t{1} << (bit.index % 64);
  if ((word & mask) != 0) return;
  word |= mask;
  const int h = 1 << step;
  const bool odd_i = (v.i & h) != 0, odd_j = (v.j & h) != 0;
  if (odd_i && odd_j) {
    // The center of a square. The diagonal that it bisects passes through the center of the next larger square. The parents are the two
    // other corners: of their coordinates, one is an odd multiple of 2h.
    if (step + 1 == level_) return;
    for (const int di : {-h, h}) {
      for (const int dj : {-h, h}) {
        if ((((v.i + di) ^ (v.j + dj)) & (2 * h)) != 0) add({v.i + di, v.j + dj});
      }
    }
  } else if (odd_i) {  // the middle of a side along u; the parents are the centers of the squares on both sides
    add({v.i, v.j - h});
    add({v.i, v.j + h});
  } else {
    add({v.i - h, v.j});
    add({v.i + h, v.j});
  }
}

bool GridVertices::contains(int patch, GridVertex v) const {
  GridVertex global{((patch % grid_.columns) << level_) + v.i, ((patch / grid_.columns) << level_) + v.j};
  wrap(global);
  const Bit bit = bit_of(global);
  const std::vector<uint64_t>& words = bits_[static_cast<std::size_t>(bit.patch)];
  return !words.empty() && (words[bit.index / 64] >> (bit.index % 64) & 1) != 0;
}

}  // namespace halfspace::HS_LANES
