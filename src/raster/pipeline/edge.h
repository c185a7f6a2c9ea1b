// SPDX-License-Identifier: Apache-2.0
//
// Edge functions in integer arithmetic, and the fill rule.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace::HS_LANES {

/// Directed edge (ex, ey) starting at (x0, y0), with the edge function E(x, y) = ex·(y − y0) − ey·(x − x0). E is positive to the left of
/// the edge, which is the inside of a counter-clockwise triangle. Coordinates are in 1/256 px, and E is in (1/256 px)².
struct Edge {
  int32_t x0, y0, ex, ey;

  int64_t at(int64_t x, int64_t y) const { return int64_t{ex} * (y - y0) - int64_t{ey} * (x - x0); }
};

/// Returns edge i of a triangle, the one opposite vertex i.
inline Edge edge_of(const Triangle& t, std::size_t i) {
  const std::size_t a = (i + 1) % 3;
  const std::size_t b = (i + 2) % 3;
  return {t.x[a], t.y[a], t.x[b] - t.x[a], t.y[b] - t.y[a]};
}

/// Fill rule: returns true if samples exactly on the edge (ex, ey) belong to the triangle. This is the case for left edges, where the
/// inside is towards +x, and for horizontal edges with the inside above them in window coordinates (y up). Images store the top row first,
/// so samples on a horizontal edge belong to the triangle whose bottom edge it is in the displayed image, unlike in D3D's top-left rule.
/// tests/mesa verifies that Mesa uses the same rule when it renders to a framebuffer object.
template <class I>
HS_INLINE auto is_top_left(I ex, I ey) {
  return ey < I(0) || (ey == I(0) && ex > I(0));
}

/// Returns the bias of an edge for the fill rule: a sample is inside if E − bias ≥ 0. I is int32_t, or Int for one edge per lane.
template <class I>
HS_INLINE I fill_bias(I ex, I ey) {
  return select(is_top_left(ex, ey), I(0), I(1));
}
inline int32_t fill_bias(const Edge& e) { return fill_bias(e.ex, e.ey); }

}  // namespace halfspace::HS_LANES
