// SPDX-License-Identifier: Apache-2.0
//
// Edge functions in whole numbers, and the fill rule.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace {

/// E(x, y) = ex·(y − y0) − ey·(x − x0) of a directed edge (ex, ey) from (x0, y0): > 0 to its left, which is the inside
/// of a counter-clockwise triangle. Everything in 1/256 px (E in its square).
struct Edge {
  int32_t x0, y0, ex, ey;

  int64_t at(int64_t x, int64_t y) const { return int64_t{ex} * (y - y0) - int64_t{ey} * (x - x0); }
};

/// Edge i lies opposite of vertex i.
inline Edge edge_of(const Triangle& t, std::size_t i) {
  const std::size_t a = (i + 1) % 3;
  const std::size_t b = (i + 2) % 3;
  return {t.x[a], t.y[a], t.x[b] - t.x[a], t.y[b] - t.y[a]};
}

/// The fill rule: a sample exactly on an edge belongs to the triangle if the edge is a left edge (the inside lies to
/// its right, towards +x) or a horizontal edge with the inside above it in window coordinates (y up). Our images hold
/// the top row first, so it is the displayed lower edge that owns its samples, not the upper one as in D3D's top-left
/// rule. tests/mesa shows that Mesa draws by the same rule into a framebuffer object.
template <class I>
HS_INLINE auto is_top_left(I ex, I ey) {
  return ey < I(0) || (ey == I(0) && ex > I(0));
}

/// Inside is E − bias ≥ 0. Of an edge (ex, ey), or lane by lane.
template <class I>
HS_INLINE I fill_bias(I ex, I ey) {
  return select(is_top_left(ex, ey), I(0), I(1));
}
inline int32_t fill_bias(const Edge& e) { return fill_bias(e.ex, e.ey); }

}  // namespace halfspace
