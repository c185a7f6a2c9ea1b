// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/trace_rejected.h"

#include <algorithm>

namespace halfspace::HS_LANES {

namespace {

// The two depths whose comparison shows that no fragment can pass.
struct ComparedDepths {
  float tested, stored;
};
ComparedDepths compared_depths(CompareOp op, const DepthBounds& tested, const DepthBounds& stored) {
  switch (op) {
    case CompareOp::less:
    case CompareOp::less_equal: return {tested.low, stored.high};
    case CompareOp::equal: return tested.high < stored.low ? ComparedDepths{tested.high, stored.low} : ComparedDepths{tested.low, stored.high};
    default: return {tested.high, stored.low};
  }
}

// Adds the covered samples in [x0, x1) x [y0, y1) of the tile's storage.
template <bool small>
void add_covered(const RejectedPrimitive& p, const TileEdges& tile_edges, const TileRect& area, FragmentOutcome outcome,
                 const ComparedDepths& depths, TileTrace& trace) {
  const DepthPlane<small> plane(p.triangle, tile_edges.bias, p.d.draw, p.grid, p.d.tile.depth_format);
  const BlockEdges edges(tile_edges);
  for (int y = area.y0 / kPacketHeight * kPacketHeight; y < area.y1; y += kPacketHeight) {
    for (int x = area.x0 / kPacketWidth * kPacketWidth; x < area.x1; x += kPacketWidth) {
      const Mask mask = edges.inside(x, y) & inside(area, x, y);
      if (any(mask)) trace.add_rejected(p.id, packet_at(x, y), bits(mask), outcome, plane.at(edges, x, y), depths.tested, depths.stored);
    }
  }
}

void add_in_area(const RejectedPrimitive& p, const TileRect& area, FragmentOutcome outcome, const ComparedDepths& depths,
                 TileTrace& trace) {
  const PixelBounds b = pixel_bounds(p.d.draw, p.triangle, p.d.bounds, p.grid.position);
  const TileRect rect{std::max(b.x0 - p.grid.x0, area.x0), std::max(b.y0 - p.grid.y0, area.y0), std::min(b.x1 - p.grid.x0, area.x1),
                      std::min(b.y1 - p.grid.y0, area.y1)};
  const TileEdges edges = tile_edges(p.d.draw, p.triangle, p.grid, p.d.tile.size);
  if (edges.outside || rect.x0 >= rect.x1 || rect.y0 >= rect.y1) return;
  if (p.triangle.is(kSmall)) {
    add_covered<true>(p, edges, rect, outcome, depths, trace);
  } else {
    add_covered<false>(p, edges, rect, outcome, depths, trace);
  }
}

}  // namespace

void trace_rejected_block(const RejectedPrimitive& p, int block, TileTrace& trace) {
  const auto b = static_cast<std::size_t>(block);
  const int x = block % kBlocksPerRow * kBlockSize, y = block / kBlocksPerRow * kBlockSize;
  add_in_area(p, {x, y, x + kBlockSize, y + kBlockSize}, FragmentOutcome::block_rejected,
              compared_depths(p.d.draw.state.depth.compare, p.z, {p.d.tile.hiz_min[b], p.d.tile.hiz_max[b]}), trace);
}

void trace_rejected_tile(const RejectedPrimitive& p, const DepthBounds& stored, TileTrace& trace) {
  add_in_area(p, {p.grid.plane.x, p.grid.plane.y, p.grid.plane.x + p.d.tile.size, p.grid.plane.y + p.d.tile.size},
              FragmentOutcome::tile_rejected, compared_depths(p.d.draw.state.depth.compare, p.z, stored), trace);
}

void trace_rejected_tile(const RejectedPrimitive& p, TileTrace& trace) {
  trace_rejected_tile(p, {*std::ranges::min_element(p.d.tile.hiz_min), *std::ranges::max_element(p.d.tile.hiz_max)}, trace);
}

}  // namespace halfspace::HS_LANES
