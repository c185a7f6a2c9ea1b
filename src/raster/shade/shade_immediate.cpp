// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/shade_immediate.h"

#include <algorithm>

#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/centroid.h"
#include "halfspace/raster/visibility/depth_stencil_test.h"

namespace halfspace {

namespace {

// Data that all samples of a primitive share.
template <class S>
struct ImmediateShading {
  using Statistics = S;

  const PassContext& context;
  const Draw& draw;
  TriangleId id;
  VisibilityMode mode;
  const CoverageList& list;
  Tile& tile;
  TransparentLayers& layers;
  FragmentOutput& output;
  const StencilFace* stencil;  // null: no stencil test after shading
  Statistics& statistics;
};

template <class Shading>
inline constexpr bool kTracesShading = kTraces<typename Shading::Statistics>;

// OpenGL 4.6, section 17.3.1: alpha to coverage enables the first round(alpha · samples) samples.
Mask alpha_covers(Real alpha, int samples, int sample) {
  return alpha * Real(static_cast<float>(samples)) >= Real(static_cast<float>(sample) + 0.5f);
}

// Returns the depth of the fragments of packet i of a batch, as represented in the tile.
template <class Shading>
Real late_depth(const Shading& c, const FragmentOutput& out, std::size_t i, int packet) {
  if (c.mode != VisibilityMode::cover_only) return load<Real>(&c.list.depth[static_cast<std::size_t>(packet) * kLanes]);
  return depth_value(c.tile.depth_format, clamp(out.depth[i], Real(c.draw.depth_low), Real(c.draw.depth_high)));
}

// Runs the tests that come after the shader. Returns the lanes to draw; writes depth and stencil.
template <class Shading>
Mask late_tests(const Shading& c, const FragmentOutput& out, std::size_t i, int packet, Mask mask) {
  const DepthState& state = c.draw.state.depth;
  const Real z = late_depth(c, out, i, packet);
  if (c.draw.kernels.discards) mask = mask & mask_from_bits<Mask>(out.keep[i]);
  [[maybe_unused]] const Mask kept = mask;
  if (c.stencil != nullptr) {
    const Mask stencil_passed = stencil_test(*c.stencil, c.tile, packet, mask);
    const Mask passed = depth_test(state, c.tile, packet, z, stencil_passed);
    if constexpr (kTracesShading<Shading>)
      c.statistics.trace->set_outcome(c.id, packet, bits(mask & !stencil_passed), FragmentOutcome::stencil_failed);
    update_stencil(*c.stencil, c.tile, packet, mask & !stencil_passed, stencil_passed & !passed, passed);
    if constexpr (kTracesShading<Shading>)
      c.statistics.trace->set_outcome(c.id, packet, bits(stencil_passed & !passed), FragmentOutcome::depth_failed);
    mask = passed;
  } else if (c.mode == VisibilityMode::cover_only) {
    mask = depth_test(state, c.tile, packet, z, mask);
    if constexpr (kTracesShading<Shading>) c.statistics.trace->set_outcome(c.id, packet, bits(kept & !mask), FragmentOutcome::depth_failed);
  }
  if constexpr (kTracesShading<Shading>) c.statistics.trace->set_depth(c.id, packet, bits(kept), z);
  c.statistics.samples_passed += static_cast<uint64_t>(std::popcount(bits(mask)));
  write_depth(state, c.tile, packet, z, mask);
  return mask;
}

// Tests and writes sample s of packet i of a batch.
template <class Shading>
void finish_sample(const Shading& c, const FragmentOutput& out, std::size_t i, int s, const PacketMask& packet) {
  Mask mask = mask_from_bits<Mask>(packet.lanes);
  if (c.draw.state.alpha_to_coverage && c.tile.samples > 1) mask = mask & alpha_covers(out.packet_color(0, i)[3], c.tile.samples, s);
  if constexpr (kTracesShading<Shading>) {
    c.statistics.trace->set_shaded(c.id, packet.packet, packet.lanes, out.packet_color(0, i));
    c.statistics.trace->set_outcome(c.id, packet.packet, packet.lanes, FragmentOutcome::discarded);  // unless something else follows
  }
  if (c.mode != VisibilityMode::early) mask = late_tests(c, out, i, packet.packet, mask);
  if (c.draw.state.order_independent) {
    const Mask merged = c.layers.add(packet.packet, mask, late_depth(c, out, i, packet.packet), out.packet_color(0, i));
    c.statistics.layers_merged += static_cast<uint64_t>(std::popcount(bits(merged)));
    if constexpr (kTracesShading<Shading>) c.statistics.trace->add_layers(c.id, packet.packet, bits(mask), bits(merged));
    return;
  }
  const PacketMask drawn{packet.packet, static_cast<uint16_t>(bits(mask))};
  write_colors(c.draw, out, i, std::span(&drawn, 1), c.tile);
  if constexpr (kTracesShading<Shading>) {
    c.statistics.trace->set_outcome(c.id, drawn.packet, drawn.lanes,
                                    blend_of(c.draw.state, 0) ? FragmentOutcome::blended : FragmentOutcome::shaded);
    c.statistics.trace->set_value(c.id, drawn.packet, drawn.lanes, c.tile.color[0]);
  }
}

// Runs the fragment function on packets, and calls finish(out, index in the batch, packet) for each of them.
template <class Shading, class F>
void shade_packets(const Shading& c, const PacketMask* packets, int count, const SamplePlane& plane, const SamplePosition& at, F finish) {
  FragmentOutput& out = c.output;
  std::array<SamplePosition, kFragmentBatch * kLanes> centroids;
  for (int begin = 0; begin < count; begin += kFragmentBatch) {
    const int n = std::min(kFragmentBatch, count - begin);
    const bool needs_centroid = c.draw.kernels.uses_centroid && c.tile.samples > 1 && !c.draw.shades_samples;
    for (int i = 0; needs_centroid && i < n; ++i) {
      const int p = packets[begin + i].packet;
      find_centroids(c.context, c.tile.x0 + packet_x(p), c.tile.y0 + packet_y(p), nullptr, c.id,
                     &centroids[static_cast<std::size_t>(i * kLanes)]);
    }
    c.draw.kernels.fragment(c.draw.shader.get(), {&c.context, c.tile.x0 - plane.x, c.tile.y0 - plane.y, at, nullptr, c.id, packets + begin,
                                                  n, needs_centroid ? centroids.data() : nullptr, &out});
    for (int i = 0; i < n; ++i) {
      const PacketMask& packet = packets[begin + i];
      c.statistics.fragments_shaded += static_cast<uint64_t>(std::popcount(packet.lanes));
      finish(out, static_cast<std::size_t>(i), packet);
    }
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

// Shades each pixel that has a covered sample once.
template <class Shading>
void shade_pixels(const Shading& c) {
  std::array<uint16_t, kPackets> covered{};  // per packet of the tile's storage
  std::array<uint16_t, kPackets> any_sample{};
  int begin = 0;
  for (int s = 0; s < c.tile.samples; ++s) {
    const int shift = packet_shift(sample_plane(c.tile.samples, s, c.tile.size));
    for (; begin < c.list.sample_end[static_cast<std::size_t>(s)]; ++begin) {
      const PacketMask& p = c.list.packets[static_cast<std::size_t>(begin)];
      covered[p.packet] = p.lanes;
      uint16_t& pixels = any_sample[static_cast<std::size_t>(p.packet - shift)];
      pixels = static_cast<uint16_t>(pixels | p.lanes);
    }
  }
  std::array<PacketMask, kPackets> packets;
  int count = 0;
  for (std::size_t p = 0; p < kPackets; ++p) {
    if (any_sample[p] != 0) packets[static_cast<std::size_t>(count++)] = {static_cast<uint16_t>(p), any_sample[p]};
  }
  shade_packets(c, packets.data(), count, {0, 0}, {kSubPixels / 2, kSubPixels / 2},
                [&](const FragmentOutput& out, std::size_t i, const PacketMask& p) {
                  for (int s = 0; s < c.tile.samples; ++s) {
                    const auto packet = static_cast<uint16_t>(p.packet + packet_shift(sample_plane(c.tile.samples, s, c.tile.size)));
                    if (covered[packet] != 0) finish_sample(c, out, i, s, {packet, covered[packet]});
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
  const ImmediateShading<Statistics> c{context, draw, id, mode, list, tile, layers, output, stencil, statistics};
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
