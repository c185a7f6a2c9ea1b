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
#include "halfspace/raster/visibility/tests/depth_stencil_test.h"
#include "halfspace/raster/visibility/tests/replaced_depth.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

// Data that all fragments share.
struct QueuedShading {
  const DrawInTile& d;
  TransparentLayers& layers;
  FragmentOutput& output;
  PassStatistics& statistics;
};

// Records that the fragment function ran for packet i of a batch. If no other outcome follows, the fragments were discarded.
inline void trace_shaded(const QueuedShading& c, const FragmentOutput& out, std::size_t i, const PacketMask& packet, TriangleId id) {
  c.d.trace->set_shaded(id, packet.packet, packet.lanes, out.packet_color(0, i));
  c.d.trace->set_outcome(id, packet.packet, packet.lanes, FragmentOutcome::discarded);
}

// Records that packet i was written.
inline void trace_written(const QueuedShading& c, const PacketMask& packet, TriangleId id) {
  c.d.trace->set_outcome(id, packet.packet, packet.lanes, blend_of(c.d.draw.state, 0) ? FragmentOutcome::blended : FragmentOutcome::shaded);
  c.d.trace->set_value(id, packet.packet, packet.lanes, c.d.tile.color[0]);
}

// OpenGL 4.6, section 17.3.1: alpha to coverage enables the first round(alpha · samples) samples.
inline Mask alpha_covers(Real alpha, int samples, int sample) {
  return alpha * Real(static_cast<float>(samples)) >= Real(static_cast<float>(sample) + 0.5f);
}

// Returns the depth of the fragments `mask` of packet i of a batch, as represented in the tile. z: depth of the triangle.
inline Real late_depth(const QueuedShading& c, const FragmentOutput& out, std::size_t i, Real z, Mask mask) {
  if (c.d.mode != VisibilityMode::cover_only) return z;
  if (c.d.draw.kernels.discards) mask = mask & mask_from_bits<Mask>(out.keep[i]);
  return replaced_depth(c.d.draw, c.d.tile.depth_format, out.depth[i], z, has_depth_bound(c.d.draw), mask);
}

// Runs the tests that come after the shader on packet i of a batch, with depth z. Returns the lanes to draw; writes depth and stencil.
inline Mask late_tests(const QueuedShading& c, const FragmentOutput& out, std::size_t i, int packet, Mask mask, Real z, TriangleId id) {
  const DepthState& state = c.d.draw.state.depth;
  if (c.d.draw.kernels.discards) mask = mask & mask_from_bits<Mask>(out.keep[i]);
  if (c.d.trace != nullptr) {
    c.d.trace->set_depth(id, packet, bits(mask), z, load<Real>(&c.d.tile.depth[static_cast<std::size_t>(packet) * kLanes]));
    c.d.trace->set_outcome(id, packet, bits(mask), FragmentOutcome::depth_failed);  // unless something else follows
  }
  if (tests_stored_depth(c.d.draw.state, c.d.tile)) mask = stored_depth_test(*c.d.draw.state.depth_bounds, c.d.tile, packet, mask);
  if (c.d.postpones_stencil) {
    const StencilFace& face = *stencil_face(c.d.draw.state, c.d.tile, triangle_of(c.d.context, id).is(kFrontFacing));
    if (c.d.trace != nullptr)
      c.d.trace->set_outcome(id, packet, bits(mask & !stencil_test(face, c.d.tile, packet, mask)), FragmentOutcome::stencil_failed);
    mask = test_and_update_stencil(face, c.d.tile, packet, mask, c.d.tests, state.compare, z);
  } else {
    mask = depth_test(state, c.d.tile, packet, z, mask);
  }
  c.statistics.samples_passed += static_cast<uint64_t>(std::popcount(bits(mask)));
  write_depth(state, c.d.tile, packet, z, mask);
  return mask;
}

inline void add_to_layers(const QueuedShading& c, const FragmentOutput& out, std::size_t i, int packet, Mask mask, Real z, TriangleId id) {
  const PacketColor color = out.packet_color(0, i);
  const Mask merged =
      c.layers.add(packet, mask, z, is_fixed_point(c.d.tile.color[0].format) ? clamped_color(color, c.d.tile.color[0].format) : color);
  c.statistics.layers_merged += static_cast<uint64_t>(std::popcount(bits(merged)));
  if (c.d.trace != nullptr) c.d.trace->add_layers(id, packet, bits(mask), bits(merged));
}

}  // namespace halfspace::HS_LANES
