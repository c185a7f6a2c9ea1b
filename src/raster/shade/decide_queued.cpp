// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/decide_queued.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "halfspace/raster/visibility/coverage/traced_writer.h"
#include "halfspace/raster/visibility/sink/centroid.h"
#include "halfspace/raster/visibility/sink/packed_pixels.h"

namespace halfspace::HS_LANES {

namespace {

// Results of the visibility function. Each array has one element more than a batch can fill, because unpacking reads past the last pixel.
struct Decisions {
  std::array<uint16_t, PacketQueue::kCapacity + 1> keep;
  alignas(64) std::array<Real, PacketQueue::kCapacity + 1> depth;  ///< if the shader writes depth
};

// Tests and writes packets in which the shader keeps some lanes.
template <class Writer>
class DecidedPackets {
 public:
  DecidedPackets(const DrawInTile& d, PacketQueue& queue, Writer& writer)
      : d_(d), queue_(queue), writer_(writer), has_bound_(has_depth_bound(d.draw)) {}

  // Finishes n packets of the queue, all samples of each. result(i, lanes) returns the keep mask and the depth of packet i.
  template <class F>
  HS_INLINE void finish_packets(std::size_t begin, std::size_t n, F result) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = begin + i;
      const auto [keep, depth] = result(i, queue_.packets[k].lanes);
      if (d_.tile.samples == 1) {
        finish(queue_.ids[k], queue_.packets[k], keep, depth, queue_.depth[k]);
        continue;
      }
      for (int s = 0; s < d_.tile.samples; ++s) finish_sample(k, s, keep, depth);
    }
  }

  // Finishes sample s of packet k of the queue.
  HS_INLINE void finish_sample(std::size_t k, int s, uint32_t keep, Real depth) {
    const PacketMask sample = queue_.sample(d_.tile, k, s);
    if (sample.lanes != 0) finish(queue_.ids[k], sample, keep, depth, queue_.sample_depth(d_.tile, k, s));
  }

 private:
  // Finishes one sample of a packet, which is `sample` in the tile's storage. keep, depth: what the shader returned. z: depth of the
  // triangle.
  HS_INLINE void finish(TriangleId id, const PacketMask& sample, uint32_t keep, Real depth, Real z) {
    const uint32_t kept = keep & sample.lanes;
    const Draw& draw = d_.draw;
    const DepthFormat format = d_.tile.depth_format;
    const bool replaces = draw.kernels.writes_depth;
    if (replaces) z = replaced_depth(draw, format, depth, z, has_bound_, mask_from_bits<Mask>(kept));
    if constexpr (Writer::kTestsStencil) writer_.begin(triangle_of(d_.context, id));
    if (!writer_.write_decided(id, sample, kept, z) || !writer_.writes_depth()) return;
    const int block = sample.packet / kPacketsPerBlock;
    if (replaces) {
      widen_hiz(CompareOp::always, d_.tile, block, {depth_value(format, draw.depth_low), depth_value(format, draw.depth_high)});
    } else {
      widen_hiz(writer_.compare_op(), d_.tile, block, depth_bounds(triangle_of(d_.context, id), draw, format));
    }
  }

  const DrawInTile& d_;
  PacketQueue& queue_;
  Writer& writer_;
  bool has_bound_;
};

// Decides the packets of the queue with one call of the visibility function per pixel.
template <class Writer>
void decide_pixels(const DrawInTile& d, PacketQueue& queue, DecidedPackets<Writer>& decided) {
  PackedPixels packed;
  Decisions decisions;
  const auto end = static_cast<std::size_t>(queue.count);
  const bool packs = packs_queue(d.draw, d.tile, std::span(queue.packets).first(end));
  const bool uses_centroids = needs_centroids(d.draw, d.tile.samples);
  for (std::size_t begin = 0; begin < end;) {
    const std::span<const PacketMask> rest(&queue.packets[begin], end - begin);
    std::size_t n;
    if (packs) {
      n = pack(rest, &queue.ids[begin], packed);
      d.draw.kernels.visibility(d.draw.shader.get(), {packed.batch(d.context, d.tile), decisions.keep.data(), decisions.depth.data()});
      std::size_t next = 0;
      decided.finish_packets(begin, n, [&](std::size_t, uint32_t lanes) {
        const std::size_t first = next;
        next += static_cast<std::size_t>(std::popcount(lanes));
        const Real depth =
            d.draw.kernels.writes_depth ? unpack_values(reinterpret_cast<const float*>(decisions.depth.data()), first, lanes) : Real(0.0f);
        return std::pair<uint32_t, Real>(unpack_keep(decisions.keep.data(), first, lanes), depth);
      });
    } else {
      // All packets at once if possible, because each call looks up its triangles again.
      n = std::min(rest.size(), uses_centroids ? std::size_t{kPacketBatch} : PacketQueue::kCapacity);
      VisibilityBatch batch{queue.batch(d.context, d.tile, begin, n), decisions.keep.data(), decisions.depth.data()};
      std::array<SamplePosition, kPacketBatch * kLanes> centroids;
      if (uses_centroids) batch.centroids = find_centroids(batch, centroids);
      d.draw.kernels.visibility(d.draw.shader.get(), batch);
      decided.finish_packets(begin, n, [&](std::size_t i, uint32_t) {
        return std::pair<uint32_t, Real>(decisions.keep[i], d.draw.kernels.writes_depth ? decisions.depth[i] : Real(0.0f));
      });
    }
    begin += n;
  }
}

// The same with one call per sample.
template <class Writer>
void decide_samples(const DrawInTile& d, const PacketQueue& queue, DecidedPackets<Writer>& decided) {
  Decisions decisions;
  for (int s = 0; s < d.tile.samples; ++s) {
    const QueuedSample sample(d.context, d.tile, queue, s);
    if (sample.count() == 0) continue;
    d.draw.kernels.visibility(d.draw.shader.get(), {sample.batch(0, sample.count()), decisions.keep.data(), decisions.depth.data()});
    for (std::size_t i = 0; i < sample.count(); ++i)
      decided.finish_sample(sample.index(i), s, decisions.keep[i], d.draw.kernels.writes_depth ? decisions.depth[i] : Real(0.0f));
  }
}

template <class Writer>
void decide_with(const DrawInTile& d, PacketQueue& queue, Writer writer) {
  DecidedPackets decided(d, queue, writer);
  if (d.tile.samples > 1 && d.draw.shades_samples) {
    decide_samples(d, queue, decided);
  } else {
    decide_pixels(d, queue, decided);
  }
  queue.count = 0;
}

}  // namespace

void decide_queued(const DrawInTile& d, PacketQueue& queue, PassStatistics& statistics) {
  const auto decide = [&]<TilePath path>() {
    if (d.trace != nullptr) return decide_with(d, queue, TracedWriter<path, false>(d, nullptr, statistics));
    decide_with(d, queue, Writer<path, false>(d, nullptr, statistics));
  };
  d.postpones_stencil || tests_stored_depth(d.draw.state, d.tile) ? decide.template operator()<TilePath::stencil>()
                                                                  : decide.template operator()<TilePath::opaque>();
}

}  // namespace halfspace::HS_LANES
