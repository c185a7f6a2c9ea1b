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

// Returns the pixels to which the kernel of a draw can write directly, or null. A trace needs the colors that the kernel returns otherwise.
template <class Statistics>
int32_t* direct_codes(const Draw& draw, Tile& tile) {
  const bool is_single =
      !kTraces<Statistics> && tile.color_count == 1 && tile.color[0].format == ColorFormat::rgba8 && !draw.kernels.is_constant;
  return is_single ? reinterpret_cast<int32_t*>(tile.color[0].bytes.data()) : nullptr;
}

// Shades packets of one draw.
template <class Statistics>
void shade_draw(const PassContext& context, Tile& tile, const Job& job, const Draw& draw, std::span<const PacketMask> packets,
                FragmentOutput& out, Statistics& statistics) {
  const bool spreads = job.share == Share::per_pixel && tile.samples > 1;
  const bool needs_centroid = draw.kernels.uses_centroid && spreads;
  std::array<SamplePosition, kPacketBatch * kLanes> centroids;
  FragmentBatch batch{
      {.context = &context, .tile_x0 = tile.x0 - job.plane.x, .tile_y0 = tile.y0 - job.plane.y, .position = job.position, .ids = job.ids},
      &out};
  if (!spreads) batch.codes = direct_codes<Statistics>(draw, tile);
  const std::size_t most = batch.codes != nullptr ? packets.size() : static_cast<std::size_t>(kPacketBatch);
  for (; !packets.empty(); packets = packets.subspan(static_cast<std::size_t>(batch.count))) {
    batch.packets = packets.data();
    batch.count = static_cast<int>(std::min(packets.size(), most));
    for (std::size_t i = 0; needs_centroid && i < static_cast<std::size_t>(batch.count); ++i) {
      const int p = packets[i].packet;
      find_centroids(context, tile.x0 + packet_x(p), tile.y0 + packet_y(p), job.ids + p * kLanes, kNoTriangle, &centroids[i * kLanes]);
    }
    if (needs_centroid) batch.centroids = centroids.data();
    draw.kernels.color(draw.shader.get(), batch);
    if (batch.codes != nullptr) continue;
    const std::span<const PacketMask> shaded = packets.first(static_cast<std::size_t>(batch.count));
    if (!spreads) write_colors(draw, out, 0, shaded, tile);
    if constexpr (kTraces<Statistics>) {
      if (!spreads) trace_visible(kNoTriangle, shaded, out, tile, *statistics.trace);
    }
    for (std::size_t i = 0; spreads && i < shaded.size(); ++i) write_samples(draw, out, i, shaded[i], job.ids, tile, statistics);
  }
}

template <class Statistics>
void run_job(const PassContext& context, Tile& tile, const Job& job, DeferredShading& memory, Statistics& statistics) {
  std::array<ShadingWork, kMaxTilePixels>& work = memory.work;
  const int count = list_work(context, tile, job, work);
  // Sort by draw, so that each shader runs on full batches. The order does not affect the result, because pixels are independent.
  const auto by_draw = [](const ShadingWork& a, const ShadingWork& b) { return a.draw < b.draw; };
  if (!std::is_sorted(work.begin(), work.begin() + count, by_draw)) std::stable_sort(work.begin(), work.begin() + count, by_draw);
  for (int begin = 0, end = 0; begin < count; begin = end) {
    const Draw* draw = work[static_cast<std::size_t>(begin)].draw;
    while (end < count && work[static_cast<std::size_t>(end)].draw == draw) {
      const PacketMask& packet = work[static_cast<std::size_t>(end)].packet;
      memory.packets[static_cast<std::size_t>(end++)] = packet;
      statistics.fragments_shaded += static_cast<uint64_t>(std::popcount(packet.lanes));
    }
    shade_draw(context, tile, job, *draw,
               std::span(memory.packets).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)), memory.output,
               statistics);
  }
}

// Returns the number of the first pixel of a packet in the sample plane of sample s.
std::size_t first_pixel(const Tile& tile, int packet, int s) {
  return static_cast<std::size_t>(packet + packet_shift(sample_plane(tile.samples, s, tile.size))) * kLanes;
}

// Returns the lanes whose triangle is shaded per pixel. lanes: those that show a triangle.
uint32_t shaded_per_pixel(const PassContext& context, const TriangleId* ids, uint32_t lanes) {
  const Int packet_ids = load<Int>(ids);
  uint32_t result = 0;
  for (uint32_t rest = lanes; rest != 0;) {
    const TriangleId id = ids[std::countr_zero(rest)];
    const uint32_t same = bits(packet_ids == Int(std::bit_cast<int32_t>(id)));
    if (!draw_of(context, id).shades_samples) result |= same & lanes;
    rest &= ~same;
  }
  return result;
}

constexpr int32_t kNoneInLane = std::bit_cast<int32_t>(kNoTriangle);

// Selects one triangle of each pixel at a time from the samples of a tile.
struct LayerSelection {
  const PassContext& context;
  const Tile& tile;
  bool may_shade_samples;  // false: no draw of the pass runs its fragment function per sample
  DeferredShading& memory;

  // Returns true if, in every pixel of the packet, all samples show the same triangle or none, and all triangles are shaded per pixel.
  bool agree(int packet) const {
    const TriangleId* ids = &tile.visibility[first_pixel(tile, packet, 0)];
    const Int first = load<Int>(ids);
    Mask same(true);
    for (int s = 1; s < tile.samples; ++s) same = same & (load<Int>(&tile.visibility[first_pixel(tile, packet, s)]) == first);
    if (!all(same)) return false;
    const uint32_t shown = bits(first != Int(kNoneInLane));
    return !may_shade_samples || shaded_per_pixel(context, ids, shown) == shown;
  }

  // Selects one unshaded triangle of each pixel of a packet, as next() does. Returns false if there is none left.
  bool next_of_packet(int packet) const {
    Int layer(kNoneInLane);
    for (int s = 0; s < tile.samples; ++s) {
      uint16_t& taken = memory.taken[static_cast<std::size_t>(packet)][static_cast<std::size_t>(s)];
      const TriangleId* at = &tile.visibility[first_pixel(tile, packet, s)];
      const Int ids = load<Int>(at);
      const Mask open = !mask_from_bits<Mask>(taken), is_empty = ids == Int(kNoneInLane);
      Mask may_start = layer == Int(kNoneInLane);
      if (may_shade_samples) may_start = may_start & mask_from_bits<Mask>(shaded_per_pixel(context, at, bits(open & !is_empty)));
      const Mask selected = open & !is_empty & (may_start | (ids == layer));
      layer = select(selected, ids, layer);
      taken = static_cast<uint16_t>(taken | bits(selected | (open & is_empty)));
    }
    store(&memory.layer[first_pixel(tile, packet, 0)], layer);
    return any(layer != Int(kNoneInLane));
  }

  // Selects one unshaded triangle of each pixel, in the order of its samples. Returns false if there is none left. is_first: nothing was
  // selected before.
  bool next(bool is_first) const {
    bool found = false;
    for (int packet = 0; packet < kPackets; ++packet) {
      if (!is_in_cell(tile, packet)) continue;
      const std::span taken(memory.taken[static_cast<std::size_t>(packet)].data(), static_cast<std::size_t>(tile.samples));
      const std::size_t first = first_pixel(tile, packet, 0);
      if (is_first && agree(packet)) {
        const Int ids = load<Int>(&tile.visibility[first]);
        store(&memory.layer[first], ids);
        std::ranges::fill(taken, static_cast<uint16_t>(kAllBits<Mask>));
        found |= any(ids != Int(kNoneInLane));
      } else if (std::ranges::all_of(taken, [](uint16_t lanes) { return lanes == kAllBits<Mask>; })) {
        std::fill_n(&memory.layer[first], kLanes, kNoTriangle);
      } else {
        found |= next_of_packet(packet);
      }
    }
    return found;
  }
};

// Returns false if no draw of the pass runs its fragment function per sample. A long list of draws is not searched for each tile.
bool may_shade_samples(const PassContext& context) {
  constexpr std::size_t max_searched = 64;
  return context.draws.size() > max_searched || std::ranges::any_of(context.draws, &Draw::shades_samples);
}

template <class Statistics>
void shade_deferred_samples(const PassContext& context, Tile& tile, DeferredShading& memory, Statistics& statistics) {
  const LayerSelection layers{context, tile, may_shade_samples(context), memory};
  for (int s = 0; s < tile.samples && layers.may_shade_samples; ++s) {
    run_job(context, tile,
            {tile.visibility.data(), sample_plane(tile.samples, s, tile.size), sample_position(tile.samples, s), Share::per_sample}, memory,
            statistics);
  }
  memory.taken.fill({});
  for (bool is_first = true; layers.next(is_first); is_first = false) {
    run_job(context, tile, {memory.layer.data(), {0, 0}, kPixelCenter, Share::per_pixel}, memory, statistics);
  }
}

}  // namespace

template <class Statistics>
void shade_full_tile(const PassContext& context, TriangleId id, Tile& tile, DeferredShading& memory, Statistics& statistics) {
  const Draw& draw = draw_of(context, id);
  statistics.fragments_shaded += kMaxTilePixels;
  std::fill_n(memory.layer.begin(), kPackets, id);
  for (std::size_t p = 0; p < kPackets; ++p) memory.packets[p] = {static_cast<uint16_t>(p), static_cast<uint16_t>(kAllBits<Mask>)};
  FragmentBatch batch{{.context = &context,
                       .tile_x0 = tile.x0,
                       .tile_y0 = tile.y0,
                       .packet_ids = memory.layer.data(),
                       .packets = memory.packets.data(),
                       .count = kPackets},
                      &memory.output,
                      direct_codes<Statistics>(draw, tile)};
  if (batch.codes != nullptr) return draw.kernels.color(draw.shader.get(), batch);
  batch.count = kPacketBatch;
  for (std::size_t first = 0; first < kPackets; first += kPacketBatch) {
    batch.packets = &memory.packets[first];
    draw.kernels.color(draw.shader.get(), batch);
    const std::span<const PacketMask> packets = std::span(memory.packets).subspan(first, kPacketBatch);
    write_colors(draw, memory.output, 0, packets, tile);
    if constexpr (kTraces<Statistics>) trace_visible(id, packets, memory.output, tile, *statistics.trace);
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
