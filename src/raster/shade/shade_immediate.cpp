// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/shade_immediate.h"

#include <algorithm>
#include <bit>

#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/centroid.h"
#include "halfspace/raster/visibility/depth_stencil_test.h"

namespace halfspace {

namespace {

// Data that all fragments share.
template <class S>
struct ImmediateShading {
  using Statistics = S;

  const PassContext& context;
  const Draw& draw;
  VisibilityMode mode;
  Tile& tile;
  TransparentLayers& layers;
  FragmentOutput& output;
  const StencilFace* stencil;  // null: no stencil test after shading
  bool tests_late;             // depth is tested after shading
  Statistics& statistics;
};
template <class Shading>
inline constexpr bool kTracesShading = kTraces<typename Shading::Statistics>;

// Records that the fragment function ran for packet i of a batch. If no other outcome follows, the fragments were discarded.
template <class Shading>
void trace_shaded(const Shading& c, const FragmentOutput& out, std::size_t i, const PacketMask& packet, TriangleId id) {
  c.statistics.trace->set_shaded(id, packet.packet, packet.lanes, out.packet_color(0, i));
  c.statistics.trace->set_outcome(id, packet.packet, packet.lanes, FragmentOutcome::discarded);
}

// Records that packet i was written.
template <class Shading>
void trace_written(const Shading& c, const PacketMask& packet, TriangleId id) {
  c.statistics.trace->set_outcome(id, packet.packet, packet.lanes,
                                  blend_of(c.draw.state, 0) ? FragmentOutcome::blended : FragmentOutcome::shaded);
  c.statistics.trace->set_value(id, packet.packet, packet.lanes, c.tile.color[0]);
}

// OpenGL 4.6, section 17.3.1: alpha to coverage enables the first round(alpha · samples) samples.
Mask alpha_covers(Real alpha, int samples, int sample) {
  return alpha * Real(static_cast<float>(samples)) >= Real(static_cast<float>(sample) + 0.5f);
}

// Returns the depth of the fragments of packet i of a batch, as represented in the tile. z: depth of the triangle.
template <class Shading>
Real late_depth(const Shading& c, const FragmentOutput& out, std::size_t i, Real z) {
  if (c.mode != VisibilityMode::cover_only) return z;
  return depth_value(c.tile.depth_format, clamp(out.depth[i], Real(c.draw.depth_low), Real(c.draw.depth_high)));
}

// Runs the tests that come after the shader on packet i of a batch, with depth z. Returns the lanes to draw; writes depth and stencil.
template <class Shading>
Mask late_tests(const Shading& c, const FragmentOutput& out, std::size_t i, int packet, Mask mask, Real z, [[maybe_unused]] TriangleId id) {
  const DepthState& state = c.draw.state.depth;
  if (c.draw.kernels.discards) mask = mask & mask_from_bits<Mask>(out.keep[i]);
  if constexpr (kTracesShading<Shading>) {
    c.statistics.trace->set_depth(id, packet, bits(mask), z, load<Real>(&c.tile.depth[static_cast<std::size_t>(packet) * kLanes]));
    c.statistics.trace->set_outcome(id, packet, bits(mask), FragmentOutcome::depth_failed);  // unless something else follows
  }
  if (c.stencil != nullptr) {
    const Mask stencil_passed = stencil_test(*c.stencil, c.tile, packet, mask);
    const Mask passed = depth_test(state, c.tile, packet, z, stencil_passed);
    if constexpr (kTracesShading<Shading>)
      c.statistics.trace->set_outcome(id, packet, bits(mask & !stencil_passed), FragmentOutcome::stencil_failed);
    update_stencil(*c.stencil, c.tile, packet, mask & !stencil_passed, stencil_passed & !passed, passed);
    mask = passed;
  } else if (c.tests_late) {
    mask = depth_test(state, c.tile, packet, z, mask);
  }
  c.statistics.samples_passed += static_cast<uint64_t>(std::popcount(bits(mask)));
  write_depth(state, c.tile, packet, z, mask);
  return mask;
}

template <class Shading>
void add_to_layers(const Shading& c, const FragmentOutput& out, std::size_t i, int packet, Mask mask, Real z,
                   [[maybe_unused]] TriangleId id) {
  const Mask merged = c.layers.add(packet, mask, z, out.packet_color(0, i));
  c.statistics.layers_merged += static_cast<uint64_t>(std::popcount(bits(merged)));
  if constexpr (kTracesShading<Shading>) c.statistics.trace->add_layers(id, packet, bits(mask), bits(merged));
}

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
  if (c.draw.state.alpha_to_coverage && c.tile.samples > 1) mask = mask & alpha_covers(out.packet_color(0, i)[3], c.tile.samples, s);
  if constexpr (kTracesShading<Shading>) trace_shaded(c, out, i, packet, c.id);
  const bool is_late = c.mode != VisibilityMode::early;
  const Real z = is_late ? late_depth(c, out, i, load<Real>(&c.list.depth[static_cast<std::size_t>(packet.packet) * kLanes])) : Real(0.0f);
  if (is_late) mask = late_tests(c, out, i, packet.packet, mask, z, c.id);
  if (c.draw.state.order_independent) return add_to_layers(c, out, i, packet.packet, mask, z, c.id);
  const PacketMask drawn{packet.packet, static_cast<uint16_t>(bits(mask))};
  write_colors(c.draw, out, i, std::span(&drawn, 1), c.tile);
  if constexpr (kTracesShading<Shading>) trace_written(c, drawn, c.id);
}

template <class Shading>
void count_fragments(const Shading& c, const PacketMask* packets, int count) {
  for (int i = 0; i < count; ++i) c.statistics.fragments_shaded += static_cast<uint64_t>(std::popcount(packets[i].lanes));
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
    const bool needs_centroid = c.draw.kernels.uses_centroid && c.tile.samples > 1 && !c.draw.shades_samples;
    for (int i = 0; needs_centroid && i < n; ++i) {
      const int p = packets[begin + i].packet;
      find_centroids(c.context, c.tile.x0 + packet_x(p), c.tile.y0 + packet_y(p), nullptr, c.id,
                     &centroids[static_cast<std::size_t>(i * kLanes)]);
    }
    const PacketBatch batch{.context = &c.context,
                            .tile_x0 = c.tile.x0 - plane.x,
                            .tile_y0 = c.tile.y0 - plane.y,
                            .position = at,
                            .packet_ids = ids.data(),
                            .packets = packets + begin,
                            .count = n,
                            .centroids = needs_centroid ? centroids.data() : nullptr};
    c.draw.kernels.fragment(c.draw.shader.get(), {batch, &out});
    count_fragments(c, packets + begin, n);
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
  std::array<uint16_t, kPackets> covered;     // lanes of the packets in `listed`, which are those of all samples
  std::array<uint16_t, kPackets> any_sample;  // lanes of the packets in `shaded`, which are those of sample 0
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

// Runs the tests of packet i of a batch, which is packet k of the queue. Returns the lanes whose color must be written.
template <class Shading>
uint16_t finish_queued(const Shading& c, const PacketQueue& queue, std::size_t k, std::size_t i) {
  const PacketMask& packet = queue.packets[k];
  const Real z = late_depth(c, c.output, i, queue.depth[k]);
  const Mask mask = late_tests(c, c.output, i, packet.packet, mask_from_bits<Mask>(packet.lanes), z, queue.ids[k]);
  if (!c.draw.state.order_independent) return static_cast<uint16_t>(bits(mask));
  add_to_layers(c, c.output, i, packet.packet, mask, z, queue.ids[k]);
  return 0;
}

// Writes packets one by one, so that the color after each of them is known.
template <class Shading>
void write_traced(const Shading& c, std::span<const PacketMask> packets, const TriangleId* ids) {
  for (std::size_t i = 0; i < packets.size(); ++i) {
    write_colors(c.draw, c.output, i, packets.subspan(i, 1), c.tile);
    trace_written(c, packets[i], ids[i]);
  }
}

// Runs the late tests of packets that were shaded as packets 0, 1, ... of the output, and writes them. begin: number of the first in the
// queue.
template <class Shading>
void finish_batch(const Shading& c, PacketQueue& queue, std::size_t begin, std::size_t n) {
  PacketMask* packets = &queue.packets[begin];
  for (std::size_t i = 0; c.mode != VisibilityMode::early && i < n; ++i) packets[i].lanes = finish_queued(c, queue, begin + i, i);
  if (c.draw.state.order_independent) return;
  const std::span<const PacketMask> written(packets, n);
  if constexpr (kTracesShading<Shading>) {
    write_traced(c, written, &queue.ids[begin]);
  } else {
    write_colors(c.draw, c.output, 0, written, c.tile);
  }
}

// Shades packets of the queue as they are. Returns their number.
template <class Shading>
std::size_t shade_batch(const Shading& c, PacketQueue& queue, std::size_t begin) {
  const std::size_t n = std::min(std::size_t{kPacketBatch}, static_cast<std::size_t>(queue.count) - begin);
  c.draw.kernels.fragment(c.draw.shader.get(), {queue.batch(c.context, c.tile, begin, n), &c.output});
  count_fragments(c, &queue.packets[begin], static_cast<int>(n));
  if constexpr (kTracesShading<Shading>) {
    for (std::size_t i = 0; i < n; ++i) trace_shaded(c, c.output, i, queue.packets[begin + i], queue.ids[begin + i]);
  }
  finish_batch(c, queue, begin, n);
  return n;
}

// The same, but moves the pixels together first.
template <class Shading>
std::size_t shade_packed(const Shading& c, PacketQueue& queue, std::size_t begin, PackedFragments& packed) {
  const std::span<const PacketMask> packets(&queue.packets[begin], static_cast<std::size_t>(queue.count) - begin);
  const std::size_t count = pack(packets, &queue.ids[begin], packed.pixels);
  c.draw.kernels.fragment(c.draw.shader.get(), {packed.pixels.batch(c.context, c.tile), &packed.output});
  c.statistics.fragments_shaded += packed.pixels.count;
  for (std::size_t done = 0, pixel = 0; done < count;) {
    const std::size_t n = std::min(std::size_t{kPacketBatch}, count - done);
    pixel = unpack(c.draw.kernels, packed.output, pixel, packets.subspan(done, n), c.output);
    finish_batch(c, queue, begin + done, n);
    done += n;
  }
  return count;
}

}  // namespace

template <class Statistics>
void shade_queued(const DrawInTile& d, PacketQueue& queue, TransparentLayers& layers, FragmentOutput& output, PackedFragments& packed,
                  Statistics& statistics) {
  const ImmediateShading<Statistics> c{d.context, d.draw, d.mode, d.tile, layers, output, nullptr, true, statistics};
  const auto count = static_cast<std::size_t>(queue.count);
  const bool packs = !kTraces<Statistics> && pays_to_pack(d.draw, std::span(queue.packets).first(count));
  for (std::size_t begin = 0; begin < count;) begin += packs ? shade_packed(c, queue, begin, packed) : shade_batch(c, queue, begin);
  queue.count = 0;
}
template void shade_queued(const DrawInTile&, PacketQueue&, TransparentLayers&, FragmentOutput&, PackedFragments&, PassStatistics&);
template void shade_queued(const DrawInTile&, PacketQueue&, TransparentLayers&, FragmentOutput&, PackedFragments&, TracedStatistics&);

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

}  // namespace halfspace
