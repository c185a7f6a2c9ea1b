// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/coverage/trace_rejected.h"

#include <algorithm>

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/tile/tile_rect.h"
#include "halfspace/raster/visibility/coverage/depth_plane.h"

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
    case CompareOp::equal:
      return tested.high < stored.low ? ComparedDepths{tested.high, stored.low} : ComparedDepths{tested.low, stored.high};
    default: return {tested.high, stored.low};
  }
}

// Adds the covered samples in a part of the tile. Pixels are numbered from the corner of the tile.
template <bool narrow>
void add_covered(const RejectedPrimitive& p, const TileRect& part, FragmentOutcome outcome, const ComparedDepths& depths,
                 TileTrace& trace) {
  const Tile& tile = p.d.tile;
  const SampleSet<false> sample(sample_position(tile.samples, static_cast<int>(p.sample)));
  const TileEdges<false> edges(p.d.draw, tile, sample, p.triangle);
  if (edges.outside()) return;
  const TileRect bounds = tile_rect(pixel_bounds(p.d.draw, p.triangle, p.d.bounds, sample.position[0]), tile);
  const TileRect rect{std::max(bounds.x0, part.x0), std::max(bounds.y0, part.y0), std::min(bounds.x1, part.x1),
                      std::min(bounds.y1, part.y1)};
  const PacketDepth<narrow, false> depth(p.triangle, p.d.draw, tile, sample, edges);
  const int shift = packet_shift(sample_plane(tile.samples, static_cast<int>(p.sample), tile.size));
  for (int y = rect.y0 / kPacketHeight * kPacketHeight; y < rect.y1; y += kPacketHeight) {
    for (int x = rect.x0 / kPacketWidth * kPacketWidth; x < rect.x1; x += kPacketWidth) {
      const uint32_t covered =
          bits(inside(rect, x, y)) & ~negative_bits(edges.values(0, 0, x, y) | edges.values(1, 0, x, y) | edges.values(2, 0, x, y));
      if (covered != 0)
        trace.add_rejected(p.id, packet_at(x, y) + shift, covered, outcome, depth.at(0, x, y), depths.tested, depths.stored);
    }
  }
}

void add_in_part(const RejectedPrimitive& p, const TileRect& part, FragmentOutcome outcome, const ComparedDepths& depths,
                 TileTrace& trace) {
  if (p.triangle.is(kNarrow)) {
    add_covered<true>(p, part, outcome, depths, trace);
  } else {
    add_covered<false>(p, part, outcome, depths, trace);
  }
}

}  // namespace

void trace_rejected_block(const RejectedPrimitive& p, int block, TileTrace& trace) {
  const Tile& tile = p.d.tile;
  const auto b = static_cast<std::size_t>(block);
  const SamplePlane plane = sample_plane(tile.samples, static_cast<int>(p.sample), tile.size);
  const int x = block % kBlocksPerRow * kBlockSize - plane.x, y = block / kBlocksPerRow * kBlockSize - plane.y;
  add_in_part(p, {x, y, x + kBlockSize, y + kBlockSize}, FragmentOutcome::block_rejected,
              compared_depths(p.d.draw.state.depth.compare, p.z, {tile.hiz_min[b], tile.hiz_max[b]}), trace);
}

void trace_rejected_tile(const RejectedPrimitive& p, const DepthBounds& stored, TileTrace& trace) {
  add_in_part(p, {0, 0, p.d.tile.size, p.d.tile.size}, FragmentOutcome::tile_rejected,
              compared_depths(p.d.draw.state.depth.compare, p.z, stored), trace);
}

void trace_rejected_tile(const RejectedPrimitive& p, TileTrace& trace) {
  trace_rejected_tile(p, {*std::ranges::min_element(p.d.tile.hiz_min), *std::ranges::max_element(p.d.tile.hiz_max)}, trace);
}

}  // namespace halfspace::HS_LANES
