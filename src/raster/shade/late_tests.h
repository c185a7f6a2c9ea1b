// SPDX-License-Identifier: Apache-2.0
//
// The steps after a queued draw has shaded its fragments: discarding, late depth and stencil tests, layers.
#pragma once

#include <bit>

#include "halfspace/raster/shade/packed_fragments.h"
#include "halfspace/raster/tile/blend_formulas.h"
#include "halfspace/raster/tile/layers.h"
#include "halfspace/raster/tile/tile_format.h"
#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/depth_stencil_test.h"

namespace halfspace::HS_LANES {

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
  bool tests_stencil;  // after shading
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
inline Mask alpha_covers(Real alpha, int samples, int sample) {
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
Mask late_tests(const Shading& c, const FragmentOutput& out, std::size_t i, int packet, Mask mask, Real z, TriangleId id) {
  const DepthState& state = c.draw.state.depth;
  if (c.draw.kernels.discards) mask = mask & mask_from_bits<Mask>(out.keep[i]);
  if constexpr (kTracesShading<Shading>) {
    c.statistics.trace->set_depth(id, packet, bits(mask), z, load<Real>(&c.tile.depth[static_cast<std::size_t>(packet) * kLanes]));
    c.statistics.trace->set_outcome(id, packet, bits(mask), FragmentOutcome::depth_failed);  // unless something else follows
  }
  if (c.tests_stencil) {
    const StencilFace& face = *stencil_face(c.draw.state, c.tile, triangle_of(c.context, id).is(kFrontFacing));
    const auto [stencil_passed, passed] = test_and_update_stencil(face, c.tile, packet, mask, tests_depth(state, c.tile), state.compare, z);
    if constexpr (kTracesShading<Shading>)
      c.statistics.trace->set_outcome(id, packet, bits(mask & !stencil_passed), FragmentOutcome::stencil_failed);
    mask = passed;
  } else {
    mask = depth_test(state, c.tile, packet, z, mask);
  }
  c.statistics.samples_passed += static_cast<uint64_t>(std::popcount(bits(mask)));
  write_depth(state, c.tile, packet, z, mask);
  return mask;
}

template <class Shading>
void add_to_layers(const Shading& c, const FragmentOutput& out, std::size_t i, int packet, Mask mask, Real z,
                   [[maybe_unused]] TriangleId id) {
  const PacketColor color = out.packet_color(0, i);
  const Mask merged = c.layers.add(packet, mask, z, is_fixed_point(c.tile.color[0].format) ? clamped_color(color) : color);
  c.statistics.layers_merged += static_cast<uint64_t>(std::popcount(bits(merged)));
  if constexpr (kTracesShading<Shading>) c.statistics.trace->add_layers(id, packet, bits(mask), bits(merged));
}

}  // namespace halfspace::HS_LANES
