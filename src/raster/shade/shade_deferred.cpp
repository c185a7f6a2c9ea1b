// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/shade_deferred.h"

#include <algorithm>
#include <bit>

#include "halfspace/core/lane_packing.h"
#include "halfspace/raster/pipeline/draw_stopwatch.h"
#include "halfspace/raster/tile/tile_rect.h"
#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/sink/centroid.h"

namespace halfspace::HS_LANES {

namespace {

// Pending pixels of a tile: the triangle of each, and the samples that are written.
struct VisiblePixels {
  const TriangleId* ids;  // indexed like the pixels of the tile's storage
  SamplePlane plane;
  SamplePosition position;
  int sample = 0;                  // number of the sample at this position
  bool copies_to_samples = false;  // a color is written to all samples that show the triangle; ids: DeferredShading::distinct
};

// Records packets that were shaded, and written as packets 0, 1, ... of `out`.
void trace_visible(TriangleId uniform, std::span<const PacketMask> packets, const FragmentOutput& out, const Tile& tile, TileTrace& trace) {
  for (std::size_t i = 0; i < packets.size(); ++i)
    trace.set_visible(uniform, tile, packets[i].packet, packets[i].lanes, out.packet_color(0, i));
}

// Returns true if the kernel of a draw can write its colors to the tile. A trace needs the colors, so the kernel returns them instead.
bool writes_directly(const Draw& draw, const Tile& tile, const TileTrace* trace) {
  return trace == nullptr && tile.color_count == 1 && !draw.kernels.is_constant;
}

// Returns the pixels that the kernel of a draw can write as RGBA8, or null.
int32_t* direct_codes(const Draw& draw, Tile& tile, const TileTrace* trace) {
  const bool is_direct = writes_directly(draw, tile, trace) && tile.color[0].format == ColorFormat::rgba8;
  return is_direct ? reinterpret_cast<int32_t*>(tile.color[0].bytes.data()) : nullptr;
}

// The same for other formats. Deferred draws replace all channels.
WriteTarget direct_target(const Draw& draw, Tile& tile, const TileTrace* trace) {
  if (!writes_directly(draw, tile, trace)) return {};
  return {write_program(tile.color[0].format, {}), &tile.color[0]};
}

// Shades the packets of one draw.
class DrawShading {
 public:
  DrawShading(const PassContext& context, Tile& tile, const VisiblePixels& pixels, const Draw& draw, DeferredShading& memory,
              TileTrace* trace)
      : context_(context),
        tile_(tile),
        pixels_(pixels),
        draw_(draw),
        memory_(memory),
        trace_(trace),
        codes_(direct_codes(draw, tile, trace)) {
    if (codes_ == nullptr && !pixels.copies_to_samples) target_ = direct_target(draw, tile, trace);
  }

  void shade(std::span<const PacketMask> packets) {
    const bool may_pack = trace_ == nullptr && !draw_.shades_samples && can_pack(draw_, tile_);
    const bool packs = may_pack && pays_to_pack(packets);
    if (packs) return shade_packed(packets);
    if (!pixels_.copies_to_samples) return shade_plane(packets, pixels_.plane);
    for (int n = 0; n < tile_.samples; ++n) {
      const SamplePlane plane = sample_plane(tile_.samples, n, tile_.size);
      const std::span<const PacketMask> in_plane = packets_in(plane, packets);
      if (n > 0 && may_pack && pays_to_pack(in_plane)) {
        shade_packed(in_plane);
      } else {
        shade_plane(in_plane, plane);
      }
    }
  }

 private:
  // Returns the packets that are stored in a sample plane.
  std::span<const PacketMask> packets_in(const SamplePlane& plane, std::span<const PacketMask> packets) {
    std::size_t count = 0;
    for (const PacketMask& p : packets) {
      const int x = packet_x(p.packet) - plane.x, y = packet_y(p.packet) - plane.y;
      memory_.plane_packets[count] = p;
      count += x >= 0 && y >= 0 && x < tile_.size && y < tile_.size ? 1 : 0;
    }
    return std::span(memory_.plane_packets).first(count);
  }

  void shade_plane(std::span<const PacketMask> packets, const SamplePlane& plane) {
    const bool needs_centroid = draw_.kernels.uses_centroid && pixels_.copies_to_samples;
    std::array<SamplePosition, kPacketBatch * kLanes> centroids;
    FragmentBatch batch{{.context = &context_,
                         .tile_x0 = tile_.x0 - plane.x,
                         .tile_y0 = tile_.y0 - plane.y,
                         .position = pixels_.position,
                         .sample = pixels_.sample,
                         .ids = pixels_.ids},
                        &memory_.output};
    batch.codes = codes_ != nullptr && pixels_.copies_to_samples ? memory_.codes.data() : codes_;
    batch.target = target_;
    const bool is_direct = batch.codes != nullptr || target_.program != nullptr;
    const std::size_t max_count = is_direct && !needs_centroid ? packets.size() : static_cast<std::size_t>(kPacketBatch);
    for (; !packets.empty(); packets = packets.subspan(static_cast<std::size_t>(batch.count))) {
      batch.packets = packets.data();
      batch.count = static_cast<int>(std::min(packets.size(), max_count));
      if (needs_centroid) batch.centroids = find_centroids(batch, centroids);
      draw_.kernels.color(draw_.shader.get(), batch);
      const std::span<const PacketMask> shaded = packets.first(static_cast<std::size_t>(batch.count));
      if (!is_direct) {
        write(shaded);
      } else if (pixels_.copies_to_samples) {
        for (const PacketMask& p : shaded) copy_codes(p, load<Int>(&memory_.codes[static_cast<std::size_t>(p.packet) * kLanes]));
      }
    }
  }

  // Shades full packets of the pixels.
  void shade_packed(std::span<const PacketMask> packets) {
    PackedFragments& packed = memory_.packed;
    std::array<int32_t, PackedPixels::kCapacity + kLanes> codes;  // unpacking reads past the last pixel
    while (!packets.empty()) {
      const std::size_t count = pack_visible(packets, pixels_.ids, tile_.size, packed.pixels);
      FragmentBatch batch{packed.pixels.batch(context_, tile_), &packed.output};
      if (codes_ != nullptr) batch.codes = codes.data();
      draw_.kernels.color(draw_.shader.get(), batch);
      if (codes_ != nullptr) {
        std::size_t pixel = 0;
        for (const PacketMask& p : packets.first(count)) {
          const Int code = as_int(unpack_lanes(load<Real>(reinterpret_cast<const float*>(&codes[pixel])), p.lanes));
          pixels_.copies_to_samples ? copy_codes(p, code) : store_codes(p.packet, mask_from_bits<Mask>(p.lanes), code);
          pixel += static_cast<std::size_t>(std::popcount(p.lanes));
        }
      } else if (target_.program != nullptr) {
        write_packed(packed.output, packets.first(count), target_);
      } else {
        std::size_t pixel = 0;
        for (std::size_t done = 0; done < count; done += kPacketBatch) {
          const std::span<const PacketMask> shaded = packets.subspan(done, std::min(std::size_t{kPacketBatch}, count - done));
          pixel = unpack(draw_.kernels, packed.output, pixel, shaded, memory_.output);
          write(shaded);
        }
      }
      packets = packets.subspan(count);
    }
  }

  HS_INLINE void store_codes(int packet, Mask mask, Int code) {
    int32_t* to = codes_ + static_cast<std::size_t>(packet) * kLanes;
    store(to, select(mask, code, load<Int>(to)));
  }

  // Calls f(packet of the sample, mask) for all samples that show the triangles of a packet of `distinct`.
  template <class F>
  HS_INLINE void for_each_sample(const PacketMask& packet, const F& f) {
    const Int shaded = load<Int>(pixels_.ids + static_cast<std::size_t>(packet.packet) * kLanes);
    const Mask lanes = mask_from_bits<Mask>(packet.lanes);
    const int pixels = packet_at(packet_x(packet.packet) & (tile_.size - 1), packet_y(packet.packet) & (tile_.size - 1));
    for (int s = 0; s < tile_.samples; ++s) {
      const int sample_packet = pixels + packet_shift(sample_plane(tile_.samples, s, tile_.size));
      const Mask shows = load<Int>(&tile_.visibility[static_cast<std::size_t>(sample_packet) * kLanes]) == shaded;
      f(sample_packet, shows & lanes);
    }
  }

  HS_INLINE void copy_codes(const PacketMask& packet, Int code) {
    for_each_sample(packet, [&](int sample_packet, Mask mask) { store_codes(sample_packet, mask, code); });
  }

  // Writes packets that were shaded as packets 0, 1, ... of the output.
  void write(std::span<const PacketMask> packets) {
    const FragmentOutput& out = memory_.output;
    if (!pixels_.copies_to_samples) {
      write_colors(draw_, out, 0, packets, tile_);
      if (trace_ != nullptr) trace_visible(kNoTriangle, packets, out, tile_, *trace_);
      return;
    }
    for (std::size_t i = 0; i < packets.size(); ++i) {
      for_each_sample(packets[i], [&](int sample_packet, Mask mask) {
        if (!any(mask)) return;
        const PacketMask sample{static_cast<uint16_t>(sample_packet), static_cast<uint16_t>(bits(mask))};
        write_colors(draw_, out, i, std::span(&sample, 1), tile_);
        if (trace_ != nullptr) trace_->set_visible(kNoTriangle, tile_, sample_packet, sample.lanes, out.packet_color(0, i));
      });
    }
  }

  const PassContext& context_;
  Tile& tile_;
  const VisiblePixels& pixels_;
  const Draw& draw_;
  DeferredShading& memory_;
  TileTrace* trace_;
  int32_t* codes_;      // colors of the tile, if the kernel can encode them
  WriteTarget target_;  // the tile, if the kernel can write colors to it in another format
};

// Shades the work draw by draw, so that each shader runs on full batches. The order of the draws does not affect the result, because pixels
// are independent.
void shade_pixels(const PassContext& context, Tile& tile, const VisiblePixels& pixels, std::span<ShadingWork> work, DeferredShading& memory,
                  PassStatistics& statistics, TileTrace* trace) {
  const auto by_draw = [](const ShadingWork& a, const ShadingWork& b) { return a.draw < b.draw; };
  bool is_sorted = std::ranges::is_sorted(work, by_draw);
  while (!work.empty()) {
    const Draw& draw = *work.front().draw;
    const std::size_t count = is_sorted ? take_sorted_draw(work, memory.packets) : take_draw(work, memory.packets);
    // More than eight passes are probably left. Sorting takes as long as three to four.
    if (!is_sorted && count < work.size() / 8) {
      std::ranges::stable_sort(work, by_draw);
      is_sorted = true;
    }
    const std::span<const PacketMask> packets = std::span(memory.packets).first(count);
    statistics.fragments_shaded += pixel_count(packets);
    const DrawStopwatch stopwatch(draw, &DrawTime::shading, statistics);
    DrawShading(context, tile, pixels, draw, memory, trace).shade(packets);
  }
}

void shade_deferred_samples(const PassContext& context, Tile& tile, DeferredShading& memory, PassStatistics& statistics, TileTrace* trace) {
  const bool per_sample = may_shade_samples(context);
  for (int s = 0; s < tile.samples && per_sample; ++s) {
    const VisiblePixels pixels{tile.visibility.data(), sample_plane(tile.samples, s, tile.size), sample_position(tile.samples, s), s};
    shade_pixels(context, tile, pixels, list_work(context, tile, pixels.ids, pixels.plane, ShadingFrequency::per_sample, memory.work),
                 memory, statistics, trace);
  }
  shade_pixels(context, tile, {memory.distinct.data(), {0, 0}, kPixelCenter, 0, true},
               list_distinct(context, tile, memory.distinct, memory.work), memory, statistics, trace);
}

}  // namespace

void shade_full_tile(const PassContext& context, TriangleId id, Tile& tile, DeferredShading& memory, PassStatistics& statistics,
                     TileTrace* trace) {
  const Draw& draw = draw_of(context, id);
  const DrawStopwatch stopwatch(draw, &DrawTime::shading, statistics);
  statistics.fragments_shaded += kMaxTilePixels;
  std::fill_n(memory.distinct.begin(), kPackets, id);
  for (std::size_t p = 0; p < kPackets; ++p) memory.packets[p] = {static_cast<uint16_t>(p), static_cast<uint16_t>(kAllBits<Mask>)};
  FragmentBatch batch{{.context = &context,
                       .tile_x0 = tile.x0,
                       .tile_y0 = tile.y0,
                       .packet_ids = memory.distinct.data(),
                       .packets = memory.packets.data(),
                       .count = kPackets},
                      &memory.output,
                      direct_codes(draw, tile, trace)};
  if (batch.codes == nullptr) batch.target = direct_target(draw, tile, trace);
  if (batch.codes != nullptr || batch.target.program != nullptr) return draw.kernels.color(draw.shader.get(), batch);
  batch.count = kPacketBatch;
  for (std::size_t first = 0; first < kPackets; first += kPacketBatch) {
    batch.packets = &memory.packets[first];
    draw.kernels.color(draw.shader.get(), batch);
    const std::span<const PacketMask> packets = std::span(memory.packets).subspan(first, kPacketBatch);
    write_colors(draw, memory.output, 0, packets, tile);
    if (trace != nullptr) trace_visible(id, packets, memory.output, tile, *trace);
  }
}

void shade_deferred(const PassContext& context, Tile& tile, DeferredShading& memory, PassStatistics& statistics, TileTrace* trace) {
  if (tile.samples == 1) {
    const VisiblePixels pixels{tile.visibility.data(), {0, 0}, kPixelCenter};
    shade_pixels(context, tile, pixels, list_work(context, tile, pixels.ids, pixels.plane, ShadingFrequency::per_pixel, memory.work),
                 memory, statistics, trace);
  } else {
    shade_deferred_samples(context, tile, memory, statistics, trace);
  }
}

}  // namespace halfspace::HS_LANES
