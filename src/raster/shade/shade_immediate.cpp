// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/shade_immediate.h"

#include <algorithm>
#include <bit>

#include "halfspace/raster/shade/late_tests.h"
#include "halfspace/raster/visibility/centroid.h"

namespace halfspace::HS_LANES {

namespace {

// Packets of one triangle.
template <class Statistics>
struct TriangleShading : ImmediateShading<Statistics> {
  TriangleId id;
  const CoverageList& list;
};

// Tests and writes sample s of packet i of a batch.
template <class Shading>
void finish_sample(const Shading& c, const FragmentOutput& out, std::size_t i, int s, const PacketMask& packet) {
  Mask mask = mask_from_bits<Mask>(packet.lanes);
  if (c.draw.covers_by_alpha) mask = mask & alpha_covers(out.packet_color(0, i)[3], c.tile.samples, s);
  if constexpr (kTracesShading<Shading>) trace_shaded(c, out, i, packet, c.id);
  const bool is_late = c.mode != VisibilityMode::early;
  const Real z = is_late ? late_depth(c, out, i, load<Real>(&c.list.depth[static_cast<std::size_t>(packet.packet) * kLanes])) : Real(0.0f);
  if (is_late) mask = late_tests(c, out, i, packet.packet, mask, z, c.id);
  if (c.draw.state.order_independent) return add_to_layers(c, out, i, packet.packet, mask, z, c.id);
  const PacketMask drawn{packet.packet, static_cast<uint16_t>(bits(mask))};
  write_colors(c.draw, out, i, std::span(&drawn, 1), c.tile);
  if constexpr (kTracesShading<Shading>) trace_written(c, drawn, c.id);
}

// Runs the fragment function on packets, and calls finish(out, index in the batch, packet) for each of them.
template <class Shading, class F>
void shade_packets(const Shading& c, const PacketMask* packets, int count, const SamplePlane& plane, const SamplePosition& at, F finish) {
  FragmentOutput& out = c.output;
  std::array<SamplePosition, kPacketBatch * kLanes> centroids;
  std::array<TriangleId, kPacketBatch> ids;
  ids.fill(c.id);
  for (int begin = 0; begin < count; begin += kPacketBatch) {
    const int n = std::min(kPacketBatch, count - begin);
    PacketBatch batch{.context = &c.context,
                      .tile_x0 = c.tile.x0 - plane.x,
                      .tile_y0 = c.tile.y0 - plane.y,
                      .position = at,
                      .packet_ids = ids.data(),
                      .packets = packets + begin,
                      .count = n};
    if (needs_centroids(c.draw, c.tile.samples)) batch.centroids = find_centroids(batch, centroids);
    c.draw.kernels.fragment(c.draw.shader.get(), {batch, &out});
    c.statistics.fragments_shaded += pixel_count({packets + begin, static_cast<std::size_t>(n)});
    for (int i = 0; i < n; ++i) finish(out, static_cast<std::size_t>(i), packets[begin + i]);
  }
}

// Shades each sample separately.
template <class Shading>
void shade_samples(const Shading& c) {
  int begin = 0;
  for (int s = 0; s < c.tile.samples; ++s) {
    const int end = c.list.sample_end[static_cast<std::size_t>(s)];
    shade_packets(c, &c.list.packets[static_cast<std::size_t>(begin)], end - begin, sample_plane(c.tile.samples, s, c.tile.size),
                  sample_position(c.tile.samples, s),
                  [&](const FragmentOutput& out, std::size_t i, const PacketMask& p) { finish_sample(c, out, i, s, p); });
    begin = end;
  }
}

// Packets of the tile's storage, one bit each.
class PacketSet {
 public:
  void add(std::size_t packet) { words_[packet / 64] |= uint64_t{1} << packet % 64; }
  bool has(std::size_t packet) const { return (words_[packet / 64] >> packet % 64 & 1) != 0; }
  /// Calls f(packet) in increasing order.
  template <class F>
  void for_each(F f) const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      for (uint64_t rest = words_[i]; rest != 0; rest &= rest - 1) f(i * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  }

 private:
  static_assert(kPackets % 64 == 0);
  std::array<uint64_t, kPackets / 64> words_{};
};

// Shades each pixel that has a covered sample once.
template <class Shading>
void shade_pixels(const Shading& c) {
  PacketSet listed, shaded;
  std::array<uint16_t, kPackets> covered;     // lanes of the packets in `listed`, for all samples
  std::array<uint16_t, kPackets> any_sample;  // lanes of the packets in `shaded`, numbered as in sample 0
  int begin = 0;
  for (int s = 0; s < c.tile.samples; ++s) {
    const int shift = packet_shift(sample_plane(c.tile.samples, s, c.tile.size));
    for (; begin < c.list.sample_end[static_cast<std::size_t>(s)]; ++begin) {
      const PacketMask& p = c.list.packets[static_cast<std::size_t>(begin)];
      const auto pixels = static_cast<std::size_t>(p.packet - shift);
      covered[p.packet] = p.lanes;
      any_sample[pixels] = static_cast<uint16_t>((shaded.has(pixels) ? any_sample[pixels] : 0) | p.lanes);
      listed.add(p.packet);
      shaded.add(pixels);
    }
  }
  std::array<PacketMask, kPackets> packets;
  int count = 0;
  shaded.for_each([&](std::size_t p) { packets[static_cast<std::size_t>(count++)] = {static_cast<uint16_t>(p), any_sample[p]}; });
  shade_packets(c, packets.data(), count, {0, 0}, kPixelCenter, [&](const FragmentOutput& out, std::size_t i, const PacketMask& p) {
    for (int s = 0; s < c.tile.samples; ++s) {
      const auto packet = static_cast<uint16_t>(p.packet + packet_shift(sample_plane(c.tile.samples, s, c.tile.size)));
      if (listed.has(packet)) finish_sample(c, out, i, s, {packet, covered[packet]});
    }
  });
}

}  // namespace

template <class Statistics>
void shade_immediate(const PassContext& context, const Draw& draw, TriangleId id, VisibilityMode mode, const CoverageList& list, Tile& tile,
                     TransparentLayers& layers, FragmentOutput& output, Statistics& statistics) {
  const Triangle& t = triangle_of(context, id);
  const bool late_stencil = mode == VisibilityMode::test_only || mode == VisibilityMode::cover_only;
  const StencilFace* stencil = late_stencil ? stencil_face(draw.state, tile, t.is(kFrontFacing)) : nullptr;
  const bool tests_late = mode == VisibilityMode::cover_only;
  const TriangleShading<Statistics> c{{context, draw, mode, tile, layers, output, stencil, tests_late, statistics}, id, list};
  if (tile.samples == 1 || draw.shades_samples) {
    shade_samples(c);
  } else {
    shade_pixels(c);
  }
}
template void shade_immediate(const PassContext&, const Draw&, TriangleId, VisibilityMode, const CoverageList&, Tile&, TransparentLayers&,
                              FragmentOutput&, PassStatistics&);
template void shade_immediate(const PassContext&, const Draw&, TriangleId, VisibilityMode, const CoverageList&, Tile&, TransparentLayers&,
                              FragmentOutput&, TracedStatistics&);

}  // namespace halfspace::HS_LANES
