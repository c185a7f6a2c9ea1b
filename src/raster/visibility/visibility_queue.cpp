// SPDX-License-Identifier: Apache-2.0
//
// Visibility of queued draws whose visibility function decides which pixels are drawn, or replaces their depth.
#include <algorithm>

#include "halfspace/raster/visibility/depth_bounds.h"
#include "halfspace/raster/visibility/opaque_writer.h"

namespace halfspace {

namespace {

// Tests and writes packet i of a batch.
template <class Writer>
void write_decided(const DrawInTile& d, const VisibilityBatch& batch, std::size_t i, Writer& writer) {
  const Draw& draw = d.draw;
  const DepthFormat format = d.tile.depth_format;
  Real z = batch.depth[i];
  if (draw.kernels.writes_depth) z = depth_value(format, clamp(z, Real(draw.depth_low), Real(draw.depth_high)));
  if (!writer.write_decided(batch.ids[i], batch.packets[i], batch.lanes[i], z) || !writer.writes_depth()) return;
  const int block = batch.packets[i] / kPacketsPerBlock;
  if (draw.kernels.writes_depth) {
    widen_hiz(CompareOp::always, d.tile, block, depth_value(format, draw.depth_low), depth_value(format, draw.depth_high));
  } else {
    const DepthBounds bounds = depth_bounds(triangle_of(d.context, batch.ids[i]), draw, format);
    widen_hiz(writer.compare_op(), d.tile, block, bounds.low, bounds.high);
  }
}

}  // namespace

template <class Statistics>
void decide_queued(const DrawInTile& d, PacketQueue& queue, Statistics& statistics) {
  OpaqueWriter writer(d, statistics);
  VisibilityBatch batch;  // only what is used is initialized
  batch.context = &d.context;
  batch.tile_x0 = d.tile.x0;
  batch.tile_y0 = d.tile.y0;
  batch.position = {kSubPixels / 2, kSubPixels / 2};
  batch.centroids = nullptr;
  for (int begin = 0; begin < queue.count; begin += kVisibilityBatch) {
    batch.count = std::min(kVisibilityBatch, queue.count - begin);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
      const std::size_t k = static_cast<std::size_t>(begin) + i;
      batch.packets[i] = queue.packets[k].packet;
      batch.lanes[i] = queue.packets[k].lanes;
      batch.ids[i] = queue.ids[k];
      batch.depth[i] = queue.depth[k];
    }
    d.draw.kernels.visibility(d.draw.shader.get(), batch);
    if constexpr (kTraces<Statistics>) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        const uint32_t listed = queue.packets[static_cast<std::size_t>(begin) + i].lanes;
        statistics.trace->set_outcome(batch.ids[i], batch.packets[i], listed & ~batch.lanes[i], FragmentOutcome::discarded);
      }
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) write_decided(d, batch, i, writer);
  }
  queue.count = 0;
}
template void decide_queued(const DrawInTile&, PacketQueue&, PassStatistics&);
template void decide_queued(const DrawInTile&, PacketQueue&, TracedStatistics&);

}  // namespace halfspace
