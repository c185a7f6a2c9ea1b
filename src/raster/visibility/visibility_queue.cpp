// SPDX-License-Identifier: Apache-2.0
//
// Visibility of queued draws whose visibility function decides which pixels are drawn, or replaces their depth.
#include <algorithm>
#include <bit>
#include <utility>

#include "halfspace/raster/visibility/centroid.h"
#include "halfspace/raster/visibility/depth_bounds.h"
#include "halfspace/raster/visibility/opaque_writer.h"
#include "halfspace/raster/visibility/packed_pixels.h"

namespace halfspace {

namespace {

// Results of the visibility function. Each array has one element more than a batch can fill, because unpacking reads past the last pixel.
struct Decisions {
  std::array<uint16_t, kPacketBatch + 1> keep;
  alignas(64) std::array<Real, kPacketBatch + 1> depth;  ///< if the shader writes depth
};

// Tests and writes a packet of which the shader keeps some lanes. z: depth from the triangle, or from the shader if it writes depth.
template <class Writer>
HS_INLINE void write_decided(const DrawInTile& d, TriangleId id, int packet, uint32_t kept, Real z, Writer& writer) {
  const Draw& draw = d.draw;
  const DepthFormat format = d.tile.depth_format;
  if (draw.kernels.writes_depth) z = depth_value(format, clamp(z, Real(draw.depth_low), Real(draw.depth_high)));
  if (!writer.write_decided(id, packet, kept, z) || !writer.writes_depth()) return;
  const int block = packet / kPacketsPerBlock;
  if (draw.kernels.writes_depth) {
    widen_hiz(CompareOp::always, d.tile, block, depth_value(format, draw.depth_low), depth_value(format, draw.depth_high));
  } else {
    const DepthBounds bounds = depth_bounds(triangle_of(d.context, id), draw, format);
    widen_hiz(writer.compare_op(), d.tile, block, bounds.low, bounds.high);
  }
}

// Finishes one sample of packet k of the queue, which is `sample` in the tile's storage. keep, depth: what the shader returned. z: depth of
// the triangle.
template <class Writer>
HS_INLINE void finish_decided(const DrawInTile& d, TriangleId id, const PacketMask& sample, uint32_t keep, Real depth, Real z,
                              Writer& writer) {
  const uint32_t kept = keep & sample.lanes;
  if constexpr (kTraces<typename Writer::Statistics>)
    writer.statistics().trace->set_outcome(id, sample.packet, sample.lanes & ~kept, FragmentOutcome::discarded);
  write_decided(d, id, sample.packet, kept, d.draw.kernels.writes_depth ? depth : z, writer);
}

// Finishes n packets of the queue. result(i, lanes) returns the keep mask and the depth of packet i.
template <class Writer, class F>
HS_INLINE void write_batch_decided(const DrawInTile& d, PacketQueue& queue, std::size_t begin, std::size_t n, Writer& writer, F result) {
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = begin + i;
    const auto [keep, depth] = result(i, queue.packets[k].lanes);
    if (d.tile.samples == 1) {
      finish_decided(d, queue.ids[k], queue.packets[k], keep, depth, queue.depth[k], writer);
      continue;
    }
    for (int s = 0; s < d.tile.samples; ++s) {
      const PacketMask sample = queue.sample(d.tile, k, s);
      if (sample.lanes != 0) finish_decided(d, queue.ids[k], sample, keep, depth, queue.sample_depth(d.tile, k, s), writer);
    }
  }
}

}  // namespace

template <class Statistics>
void decide_queued(const DrawInTile& d, PacketQueue& queue, Statistics& statistics) {
  OpaqueWriter writer(d, statistics);
  PackedPixels packed;
  Decisions decisions;
  const auto end = static_cast<std::size_t>(queue.count);
  const bool packs = packs_queue(d.draw, d.tile, std::span(queue.packets).first(end));
  for (std::size_t begin = 0; begin < end;) {
    const std::span<const PacketMask> rest(&queue.packets[begin], end - begin);
    std::size_t n;
    if (packs) {
      n = pack(rest, &queue.ids[begin], packed);
      d.draw.kernels.visibility(d.draw.shader.get(), {packed.batch(d.context, d.tile), decisions.keep.data(), decisions.depth.data()});
      std::size_t next = 0;
      write_batch_decided(d, queue, begin, n, writer, [&](std::size_t, uint32_t lanes) {
        const std::size_t first = next;
        next += static_cast<std::size_t>(std::popcount(lanes));
        const Real depth =
            d.draw.kernels.writes_depth ? unpack_values(reinterpret_cast<const float*>(decisions.depth.data()), first, lanes) : Real(0.0f);
        return std::pair<uint32_t, Real>(unpack_keep(decisions.keep.data(), first, lanes), depth);
      });
    } else {
      n = std::min(std::size_t{kPacketBatch}, rest.size());
      VisibilityBatch batch{queue.batch(d.context, d.tile, begin, n), decisions.keep.data(), decisions.depth.data()};
      std::array<SamplePosition, kPacketBatch * kLanes> centroids;
      if (d.tile.samples > 1 && d.draw.kernels.uses_centroid) batch.centroids = find_centroids(batch, centroids);
      d.draw.kernels.visibility(d.draw.shader.get(), batch);
      write_batch_decided(d, queue, begin, n, writer, [&](std::size_t i, uint32_t) {
        return std::pair<uint32_t, Real>(decisions.keep[i], d.draw.kernels.writes_depth ? decisions.depth[i] : Real(0.0f));
      });
    }
    begin += n;
  }
  queue.count = 0;
}
template void decide_queued(const DrawInTile&, PacketQueue&, PassStatistics&);
template void decide_queued(const DrawInTile&, PacketQueue&, TracedStatistics&);

}  // namespace halfspace
