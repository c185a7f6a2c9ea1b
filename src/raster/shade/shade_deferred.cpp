// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/shade_deferred.h"

#include <algorithm>
#include <bit>

#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/centroid.h"

namespace halfspace {

namespace {

// Selects the pending pixels to shade, by whether their draw is shaded per pixel or per sample.
enum class Share : uint8_t { per_pixel, per_sample };

// One run over the pending pixels of a tile: the triangle of each pixel, and the samples that are written.
struct Job {
  const TriangleId* ids;  // indexed like the pixels of the tile's storage
  SamplePlane plane;
  SamplePosition position;
  Share share;
};

bool is_in_cell(const Tile& tile, int packet) { return packet_x(packet) < tile.size && packet_y(packet) < tile.size; }

// Lists the pending pixels by packet. A packet that shows several draws has an entry for each. Returns the number of entries.
HS_INLINE int list_work(const PassContext& context, const Tile& tile, const Job& job, std::array<ShadingWork, kMaxTilePixels>& work) {
  int count = 0;
  const bool whole = tile.size == kMaxTileSize;
  const int shift = packet_shift(job.plane);
  const Draw* only_draw =
      context.draws.size() == 1 && !context.draws[0].shades_samples && job.share == Share::per_pixel ? &context.draws[0] : nullptr;
  for (int pixels = 0; pixels < kPackets; ++pixels) {
    if (!whole && !is_in_cell(tile, pixels)) continue;
    const int p = pixels + shift;
    const TriangleId* ids = job.ids + static_cast<std::size_t>(p) * kLanes;
    const Int packet_ids = load<Int>(ids);
    uint32_t rest = bits(packet_ids != Int(std::bit_cast<int32_t>(kNoTriangle)));
    const int first = count;
    if (rest != 0 && only_draw != nullptr) {
      work[static_cast<std::size_t>(count++)] = {only_draw, {static_cast<uint16_t>(p), static_cast<uint16_t>(rest)}};
      continue;
    }
    while (rest != 0) {
      const TriangleId id = ids[std::countr_zero(rest)];
      const uint32_t same = bits(packet_ids == Int(std::bit_cast<int32_t>(id)));
      rest &= ~same;
      const Draw* draw = &draw_of(context, id);
      if (draw->shades_samples != (job.share == Share::per_sample)) continue;
      int i = first;
      while (i < count && work[static_cast<std::size_t>(i)].draw != draw) ++i;
      if (i == count) work[static_cast<std::size_t>(count++)] = {draw, {static_cast<uint16_t>(p), 0}};
      ShadingWork& w = work[static_cast<std::size_t>(i)];
      w.packet.lanes = static_cast<uint16_t>(w.packet.lanes | same);
    }
  }
  return count;
}

// Writes the color of a pixel to all its samples in which the shaded triangle is visible.
template <class Statistics>
void write_samples(const Draw& draw, const FragmentOutput& out, std::size_t i, const PacketMask& packet, const TriangleId* ids, Tile& tile,
                   [[maybe_unused]] Statistics& statistics) {
  const Int shaded = load<Int>(ids + static_cast<std::size_t>(packet.packet) * kLanes);
  for (int s = 0; s < tile.samples; ++s) {
    const int sample_packet = packet.packet + packet_shift(sample_plane(tile.samples, s, tile.size));
    const Mask shows = load<Int>(&tile.visibility[static_cast<std::size_t>(sample_packet) * kLanes]) == shaded;
    const Mask mask = shows & mask_from_bits<Mask>(packet.lanes);
    if (!any(mask)) continue;
    const PacketMask sample{static_cast<uint16_t>(sample_packet), static_cast<uint16_t>(bits(mask))};
    write_colors(draw, out, i, std::span(&sample, 1), tile);
    if constexpr (kTraces<Statistics>)
      statistics.trace->set_visible(kNoTriangle, tile, sample_packet, sample.lanes, out.packet_color(0, i));
  }
}

// Records packets that were shaded, and written as packets 0, 1, ... of `out`.
void trace_visible(TriangleId uniform, std::span<const PacketMask> packets, const FragmentOutput& out, const Tile& tile, TileTrace& trace) {
  for (std::size_t i = 0; i < packets.size(); ++i)
    trace.set_visible(uniform, tile, packets[i].packet, packets[i].lanes, out.packet_color(0, i));
}

template <class Statistics>
void run_job(const PassContext& context, Tile& tile, const Job& job, DeferredShading& memory, Statistics& statistics) {
  std::array<ShadingWork, kMaxTilePixels>& work = memory.work;
  const int count = list_work(context, tile, job, work);
  // Sort by draw, so that each shader runs on full batches. The order does not affect the result, because pixels are independent.
  const auto by_draw = [](const ShadingWork& a, const ShadingWork& b) { return a.draw < b.draw; };
  if (!std::is_sorted(work.begin(), work.begin() + count, by_draw)) std::stable_sort(work.begin(), work.begin() + count, by_draw);
  FragmentOutput& out = memory.output;
  std::array<PacketMask, kFragmentBatch> packets;
  std::array<SamplePosition, kFragmentBatch * kLanes> centroids;
  for (int begin = 0; begin < count;) {
    const Draw& draw = *work[static_cast<std::size_t>(begin)].draw;
    int n = 0;
    while (n < kFragmentBatch && begin + n < count && work[static_cast<std::size_t>(begin + n)].draw == &draw) {
      packets[static_cast<std::size_t>(n)] = work[static_cast<std::size_t>(begin + n)].packet;
      statistics.fragments_shaded += static_cast<uint64_t>(std::popcount(packets[static_cast<std::size_t>(n)].lanes));
      ++n;
    }
    const bool needs_centroid = draw.kernels.uses_centroid && tile.samples > 1 && job.share == Share::per_pixel;
    for (std::size_t i = 0; needs_centroid && i < static_cast<std::size_t>(n); ++i) {
      const int p = packets[i].packet;
      find_centroids(context, tile.x0 + packet_x(p), tile.y0 + packet_y(p), job.ids + p * kLanes, kNoTriangle, &centroids[i * kLanes]);
    }
    draw.kernels.color(draw.shader.get(), {&context, tile.x0 - job.plane.x, tile.y0 - job.plane.y, job.position, job.ids, nullptr,
                                           packets.data(), n, needs_centroid ? centroids.data() : nullptr, &out});
    if (job.share == Share::per_pixel && tile.samples > 1) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) write_samples(draw, out, i, packets[i], job.ids, tile, statistics);
    } else {
      write_colors(draw, out, 0, std::span(packets).first(static_cast<std::size_t>(n)), tile);
      if constexpr (kTraces<Statistics>)
        trace_visible(kNoTriangle, std::span(packets).first(static_cast<std::size_t>(n)), out, tile, *statistics.trace);
    }
    begin += n;
  }
}

constexpr SamplePosition kPixelCenter{kSubPixels / 2, kSubPixels / 2};

// Selects one unshaded triangle of each pixel, in the order of its samples. Returns false if there is none left. taken: bit mask of the
// samples whose triangle was selected before.
HS_INLINE bool next_layer(const PassContext& context, const Tile& tile, std::array<uint8_t, kMaxTilePixels>& taken,
                          std::array<TriangleId, kMaxTilePixels>& layer) {
  bool found = false;
  for (int packet = 0; packet < kPackets; ++packet) {
    if (!is_in_cell(tile, packet)) continue;
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto pixel = static_cast<std::size_t>(packet * kLanes + lane);
      layer[pixel] = kNoTriangle;
      for (int s = 0; s < tile.samples; ++s) {
        if ((taken[pixel] >> s & 1) != 0) continue;
        const auto shift = static_cast<std::size_t>(packet_shift(sample_plane(tile.samples, s, tile.size))) * kLanes;
        const TriangleId id = tile.visibility[pixel + shift];
        const bool waits = id != kNoTriangle && (layer[pixel] == kNoTriangle ? !draw_of(context, id).shades_samples : id == layer[pixel]);
        if (waits) layer[pixel] = id;
        if (waits || id == kNoTriangle) taken[pixel] = static_cast<uint8_t>(taken[pixel] | 1 << s);
      }
      found |= layer[pixel] != kNoTriangle;
    }
  }
  return found;
}

template <class Statistics>
void shade_deferred_samples(const PassContext& context, Tile& tile, DeferredShading& memory, Statistics& statistics) {
  for (int s = 0; s < tile.samples; ++s) {
    run_job(context, tile,
            {tile.visibility.data(), sample_plane(tile.samples, s, tile.size), sample_position(tile.samples, s), Share::per_sample}, memory,
            statistics);
  }
  memory.taken.fill(0);
  while (next_layer(context, tile, memory.taken, memory.layer)) {
    run_job(context, tile, {memory.layer.data(), {0, 0}, kPixelCenter, Share::per_pixel}, memory, statistics);
  }
}

}  // namespace

template <class Statistics>
void shade_full_tile(const PassContext& context, TriangleId id, Tile& tile, DeferredShading& memory, Statistics& statistics) {
  const Draw& draw = draw_of(context, id);
  statistics.fragments_shaded += kMaxTilePixels;
  FragmentOutput& out = memory.output;
  std::array<PacketMask, kFragmentBatch> packets;
  std::array<TriangleId, kFragmentBatch> ids;
  ids.fill(id);
  for (int first = 0; first < kPackets; first += kFragmentBatch) {
    for (int i = 0; i < kFragmentBatch; ++i)
      packets[static_cast<std::size_t>(i)] = {static_cast<uint16_t>(first + i), static_cast<uint16_t>(kAllBits<Mask>)};
    draw.kernels.color(draw.shader.get(),
                       {&context, tile.x0, tile.y0, kPixelCenter, nullptr, ids.data(), packets.data(), kFragmentBatch, nullptr, &out});
    write_colors(draw, out, 0, packets, tile);
    if constexpr (kTraces<Statistics>) trace_visible(id, packets, out, tile, *statistics.trace);
  }
}
template void shade_full_tile(const PassContext&, TriangleId, Tile&, DeferredShading&, PassStatistics&);
template void shade_full_tile(const PassContext&, TriangleId, Tile&, DeferredShading&, TracedStatistics&);

template <class Statistics>
void shade_deferred(const PassContext& context, Tile& tile, DeferredShading& memory, Statistics& statistics) {
  if (tile.samples == 1) {
    run_job(context, tile, {tile.visibility.data(), {0, 0}, kPixelCenter, Share::per_pixel}, memory, statistics);
  } else {
    shade_deferred_samples(context, tile, memory, statistics);
  }
  tile.visibility.fill(kNoTriangle);
}
template void shade_deferred(const PassContext&, Tile&, DeferredShading&, PassStatistics&);
template void shade_deferred(const PassContext&, Tile&, DeferredShading&, TracedStatistics&);

}  // namespace halfspace
