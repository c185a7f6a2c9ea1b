// SPDX-License-Identifier: Apache-2.0
//
// The general rasterizer, for draws that none of the faster ones supports: visits the packets that a triangle covers, tests each, and
// writes or lists the samples that pass.
#include <algorithm>
#include <bit>

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/visibility/block_edges.h"
#include "halfspace/raster/visibility/centroid.h"
#include "halfspace/raster/visibility/depth_bounds.h"
#include "halfspace/raster/visibility/depth_stencil_test.h"
#include "halfspace/raster/visibility/trace_rejected.h"
#include "halfspace/raster/visibility/triangle_visit.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

namespace {

// Records the lanes of a packet that passed all tests before shading, and those that did not. Call it before depth is written.
template <class Visit>
void trace_packet(const Visit& c, int packet, Mask passed, Mask failed, FragmentOutcome failure, Real z) {
  const Real stored = load<Real>(&c.tile.depth[static_cast<std::size_t>(packet) * kLanes]);
  const FragmentOutcome outcome =
      c.mode == VisibilityMode::depth_only ? FragmentOutcome::depth_only : FragmentOutcome::hidden_before_shading;
  c.statistics.trace->add(c.id, packet, bits(passed), outcome, z, stored, c.draw_in_tile.tests);
  c.statistics.trace->add(c.id, packet, bits(failed), failure, z, stored, c.draw_in_tile.tests);
}

// Runs the stencil test and the depth test, and updates the stencil values.
template <class Visit>
Mask test_with_stencil(const Visit& c, int packet, Real z, Mask mask) {
  const auto [stencil_passed, passed] = test_and_update_stencil(*c.stencil, c.tile, packet, mask, c.tests, c.draw.state.depth.compare, z);
  if constexpr (kTraces<typename Visit::Statistics>) {
    trace_packet(c, packet, passed, stencil_passed & !passed, FragmentOutcome::depth_failed, z);
    trace_packet(c, packet, Mask(false), mask & !stencil_passed, FragmentOutcome::stencil_failed, z);
  }
  return passed;
}

// Writes or lists the lanes that passed, depending on the mode.
template <class Visit>
HS_INLINE void finish_packet(const Visit& c, int packet, Mask mask, Real z) {
  const uint32_t lanes = bits(mask);
  if (lanes == 0) return;
  Tile& tile = c.tile;
  const std::size_t first = static_cast<std::size_t>(packet) * kLanes;
  if (c.writes && c.mode != VisibilityMode::test_only) {
    store(&tile.depth[first], select(mask, z, load<Real>(&tile.depth[first])));
  }
  if (shades_later(c.mode)) {
    c.statistics.samples_passed += static_cast<uint64_t>(std::popcount(lanes));
    if (c.mode == VisibilityMode::deferred) {
      store(&tile.visibility[first], select(mask, Int(std::bit_cast<int32_t>(c.id)), load<Int>(&tile.visibility[first])));
    }
    return;
  }
  if (c.mode == VisibilityMode::early) c.statistics.samples_passed += static_cast<uint64_t>(std::popcount(lanes));
  if (c.mode == VisibilityMode::test_only) store(&c.list->depth[first], z);
  c.list->packets[static_cast<std::size_t>(c.list->count++)] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(lanes)};
}

template <class Visit>
Mask test_depth(const Visit& c, int packet, Real z, Mask mask) {
  if (!c.tests) return mask;
  return mask & compare(c.draw.state.depth.compare, z, load<Real>(&c.tile.depth[static_cast<std::size_t>(packet) * kLanes]));
}

// The same, where this is the last test before the packet is finished.
template <class Visit>
HS_INLINE Mask test_depth_last(const Visit& c, int packet, Real z, Mask mask) {
  const Mask passed = test_depth(c, packet, z, mask);
  if constexpr (kTraces<typename Visit::Statistics>) trace_packet(c, packet, passed, mask & !passed, FragmentOutcome::depth_failed, z);
  return passed;
}

template <class Visit>
void test_and_finish(const Visit& c, int packet, Mask mask, Real z) {
  mask = c.stencil != nullptr ? test_with_stencil(c, packet, z, mask) : test_depth_last(c, packet, z, mask);
  finish_packet(c, packet, mask, z);
}

// Calls the visibility function for the pending packets, and finishes them. The function clears the bits of discarded pixels in the masks
// of the packets, and may replace their depth.
template <class Visit>
void run_visibility_function(const Visit& c) {
  PendingPackets& pending = c.pending;
  if (pending.count == 0) return;
  const auto count = static_cast<std::size_t>(pending.count);
  std::array<SamplePosition, kPacketBatch * kLanes> centroids;
  std::array<TriangleId, kPacketBatch> ids;
  ids.fill(c.id);
  std::array<uint16_t, kPacketBatch> keep;
  PacketBatch packets{.context = &c.context,
                      .tile_x0 = c.grid.x0,
                      .tile_y0 = c.grid.y0,
                      .position = c.draw.shades_samples ? c.grid.position : kPixelCenter,
                      .packet_ids = ids.data(),
                      .packets = pending.packets.data(),
                      .count = pending.count};
  if (needs_centroids(c.draw, c.tile.samples)) packets.centroids = find_centroids(packets, centroids);
  c.draw.kernels.visibility(c.draw.shader.get(), {packets, keep.data(), pending.depth.data()});
  for (std::size_t i = 0; i < count; ++i) {
    const auto [packet, lanes] = pending.packets[i];
    Real z = pending.depth[i];
    if constexpr (kTraces<typename Visit::Statistics>)
      trace_packet(c, packet, Mask(false), mask_from_bits<Mask>(lanes & ~keep[i]), FragmentOutcome::discarded, z);
    if (c.draw.kernels.writes_depth) z = depth_value(c.tile.depth_format, clamp(z, Real(c.draw.depth_low), Real(c.draw.depth_high)));
    test_and_finish(c, packet, mask_from_bits<Mask>(lanes & keep[i]), z);
  }
  pending.count = 0;
}

// Processes a packet if the shader or the stencil test determines visibility.
template <class Visit>
__attribute__((noinline)) void visit_packet_slowly(const Visit& c, int packet, Mask mask, Real z) {
  if (c.mode == VisibilityMode::cover_only) {
    if constexpr (kTraces<typename Visit::Statistics>) trace_packet(c, packet, mask, Mask(false), FragmentOutcome::depth_failed, z);
    c.list->packets[static_cast<std::size_t>(c.list->count++)] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(bits(mask))};
    return;
  }
  if (!c.runs_visibility_function) return test_and_finish(c, packet, mask, z);
  // If the shader does not change depth, lanes that fail the depth test can be skipped. With a stencil test, they update the stencil.
  if (!c.draw.kernels.writes_depth && c.stencil == nullptr) {
    const Mask passed = test_depth(c, packet, z, mask);
    if constexpr (kTraces<typename Visit::Statistics>)
      trace_packet(c, packet, Mask(false), mask & !passed, FragmentOutcome::depth_failed, z);
    mask = passed;
  }
  const uint32_t lanes = bits(mask);
  if (lanes == 0) return;
  PendingPackets& pending = c.pending;
  const auto i = static_cast<std::size_t>(pending.count++);
  pending.packets[i] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(lanes)};
  pending.depth[i] = z;
  if (pending.count == kPacketBatch) run_visibility_function(c);
}

template <class Visit>
void visit_packet(const Visit& c, int packet, Mask mask, Real z) {
  c.statistics.samples_tested += static_cast<uint64_t>(std::popcount(bits(mask)));
  if (c.is_slow) return visit_packet_slowly(c, packet, mask, z);
  finish_packet(c, packet, test_depth_last(c, packet, z, mask), z);
}

// Called before the packets of a block. Returns false if none of its pixels can pass.
template <class Visit>
bool enters_block(const Visit& c, int block) {
  const bool enters = !c.rejects_blocks || test_block(c.draw.state.depth.compare, c.tile, block, c.low, c.high) != BlockTest::none_passes;
  if constexpr (kTraces<typename Visit::Statistics>) {
    if (!enters) trace_rejected_block({c.draw_in_tile, c.triangle, c.id, c.grid, c.low, c.high}, block, *c.statistics.trace);
  }
  return enters;
}
// Called after the packets of a block.
template <class Visit>
void leave_block(const Visit& c, int block) {
  if (!c.writes || c.mode == VisibilityMode::cover_only) return;
  widen_hiz(c.draw.kernels.writes_depth ? CompareOp::always : c.draw.state.depth.compare, c.tile, block, c.low, c.high);
}

template <bool small, class Visit>
void visit_block(const Visit& c, const BlockEdges& edges, const DepthPlane<small>& plane, const TileRect& rect, bool whole, int block) {
  if (!enters_block(c, block)) return;
  for (int packet = block * kPacketsPerBlock; packet < (block + 1) * kPacketsPerBlock; ++packet) {
    const int x = packet_x(packet), y = packet_y(packet);
    if (x >= rect.x1 || y >= rect.y1 || x + kPacketWidth <= rect.x0 || y + kPacketHeight <= rect.y0) continue;
    Mask mask = whole ? Mask(true) : edges.inside(x, y);
    if (c.needs_bounds_test) mask = mask & inside(rect, x, y);
    if (any(mask)) visit_packet(c, packet, mask, plane.at(edges, x, y));
  }
  leave_block(c, block);
}

constexpr int kBlockMask = ~(kBlockSize - 1);

// Finds the bounds of all depths that may be written: the bounds of the primitive, or the whole range if the shader writes depth.
template <class Visit>
void find_depth_bounds(Visit& c) {
  const DepthBounds bounds = depth_bounds(c.triangle, c.draw, c.tile.depth_format);
  const bool any_depth = c.runs_visibility_function && c.draw.kernels.writes_depth;
  c.low = any_depth ? depth_value(c.tile.depth_format, c.draw.depth_low) : bounds.low;
  c.high = any_depth ? depth_value(c.tile.depth_format, c.draw.depth_high) : bounds.high;
}

template <bool small, class Visit>
void visit_triangle(Visit& c, const TileEdges& tile_edges, const TileRect& rect) {
  const DepthPlane<small> plane(c.triangle, tile_edges.bias, c.draw, c.grid, c.tile.depth_format);
  find_depth_bounds(c);
  const BlockEdges edges(tile_edges);
  for (int y = rect.y0 & kBlockMask; y < rect.y1; y += kBlockSize) {
    for (int x = rect.x0 & kBlockMask; x < rect.x1; x += kBlockSize) {
      const BlockCoverage coverage = block_coverage(edges, x, y);
      const int block = y / kBlockSize * kBlocksPerRow + x / kBlockSize;
      if (coverage != BlockCoverage::none) visit_block<small>(c, edges, plane, rect, coverage == BlockCoverage::whole, block);
    }
  }
}

// A point covers a rectangle and has a constant depth.
template <class Visit>
void visit_point_sprite(Visit& c, const TileRect& rect) {
  find_depth_bounds(c);
  const Real z(depth_value(c.tile.depth_format, std::clamp(c.triangle.z0, c.draw.depth_low, c.draw.depth_high)));
  for (int by = rect.y0 & kBlockMask; by < rect.y1; by += kBlockSize) {
    for (int bx = rect.x0 & kBlockMask; bx < rect.x1; bx += kBlockSize) {
      const int block = by / kBlockSize * kBlocksPerRow + bx / kBlockSize;
      if (!enters_block(c, block)) continue;
      const int x1 = std::min(bx + kBlockSize, rect.x1), y1 = std::min(by + kBlockSize, rect.y1);
      for (int y = std::max(by, rect.y0 & ~(kPacketHeight - 1)); y < y1; y += kPacketHeight) {
        for (int x = std::max(bx, rect.x0 & ~(kPacketWidth - 1)); x < x1; x += kPacketWidth) {
          visit_packet(c, packet_at(x, y), inside(rect, x, y), z);
        }
      }
      leave_block(c, block);
    }
  }
}

template <class Visit>
void rasterize_sample(Visit& c, const PixelBounds& b) {
  const Triangle& t = c.triangle;
  const TileRect rect{b.x0 - c.grid.x0, b.y0 - c.grid.y0, b.x1 - c.grid.x0, b.y1 - c.grid.y0};
  if (t.is(kPointSprite)) return visit_point_sprite(c, rect);
  const TileEdges edges = tile_edges(c.draw, t, c.grid, c.tile.size);
  if (edges.outside) return;
  if (t.is(kSmall)) {
    visit_triangle<true>(c, edges, rect);
  } else {
    visit_triangle<false>(c, edges, rect);
  }
}

}  // namespace

template <class Statistics>
void rasterize(const DrawInTile& d, uint32_t chunk, uint32_t index, CoverageList* list, Statistics& statistics) {
  const Triangle& t = d.context.chunks[chunk].triangles[index];
  const StencilFace* stencil = stencil_face(d.draw.state, d.tile, t.is(kFrontFacing));
  // If the shader determines visibility later, both tests are postponed as well, because stencil updates depend on the final result.
  const bool late = d.mode == VisibilityMode::test_only && stencil != nullptr;
  const bool tests = !late && d.tests;
  const bool counts_failures = stencil != nullptr && (stencil->fail != StencilOp::keep || stencil->depth_fail != StencilOp::keep);
  const bool shader_writes_depth = d.runs_visibility_function && d.draw.kernels.writes_depth;
  PendingPackets pending;  // only the count is initialized
  TriangleVisit<Statistics> c{
      .context = d.context,
      .draw = d.draw,
      .triangle = t,
      .id = triangle_id(chunk, index),
      .mode = d.mode,
      .tile = d.tile,
      .list = list,
      .statistics = statistics,
      .stencil = late ? nullptr : stencil,
      .tests = tests,
      .writes = tests && d.draw.state.depth.write,
      .runs_visibility_function = d.runs_visibility_function,
      .rejects_blocks = tests && !shader_writes_depth && !counts_failures && d.mode != VisibilityMode::cover_only,
      .is_slow = d.runs_visibility_function || d.mode == VisibilityMode::cover_only || (stencil != nullptr && !late),
      .needs_bounds_test = d.needs_bounds_test || t.is(kPointSprite | kLine),
      .pending = pending,
      .grid = SampleGrid(d.tile, 0),
      .draw_in_tile = d,
  };
  for (int s = 0; s < d.tile.samples; ++s) {
    if (s != 0) c.grid = SampleGrid(d.tile, s);
    if ((d.draw.sample_mask >> s & 1) != 0) {
      const PixelBounds b = pixel_bounds(d.draw, t, d.bounds, c.grid.position);
      if (!b.empty()) rasterize_sample(c, b);
      run_visibility_function(c);
    }
    if (list != nullptr) list->sample_end[static_cast<std::size_t>(s)] = list->count;
  }
}
template void rasterize(const DrawInTile&, uint32_t, uint32_t, CoverageList*, PassStatistics&);
template void rasterize(const DrawInTile&, uint32_t, uint32_t, CoverageList*, TracedStatistics&);

}  // namespace halfspace::HS_LANES
