// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/visibility.h"

#include <algorithm>
#include <limits>

#include "halfspace/raster/visibility/tests/depth_stencil_test.h"

namespace halfspace::HS_LANES {

VisibilityMode visibility_mode(const Draw& draw) {
  if (draw.deferred) return VisibilityMode::deferred;
  if (draw.kernels.fragment == nullptr) return VisibilityMode::depth_only;
  const bool is_early = draw.kernels.tests_early, discards = draw.kernels.discards && !is_early;
  const bool needs_fragments = (!is_early && (draw.covers_by_alpha || draw.covers_by_shader)) || draw.state.order_independent;
  const bool is_undecided = (discards || draw.kernels.writes_depth) && draw.kernels.visibility == nullptr;
  if (!draw.writes_color && !needs_fragments && !is_undecided) return VisibilityMode::depth_only;
  if (draw.kernels.writes_depth) return VisibilityMode::cover_only;
  if (discards || needs_fragments) return VisibilityMode::test_only;
  return VisibilityMode::early;
}

namespace {

// Returns true if a draw benefits from prefetching its vertices. Triangles that are shaded immediately do, because the shader reads their
// vertices soon. In deferred draws, triangles that share vertices do, because each vertex is used several times. Points do, because the
// points of a tile are scattered in memory.
bool fetches_vertices_ahead(const Draw& draw, VisibilityMode mode) {
  if (mode == VisibilityMode::depth_only || draw.kernels.fragment == nullptr || draw.kernels.varying_count == 0) return false;
  return mode != VisibilityMode::deferred || draws_points(draw.state) || draw.indices->used_count() < draw.primitive_count;
}

// Returns true if the shader decides which fragments update the stencil values, so that the stencil test must follow it.
bool postpones_stencil(const Draw& draw, VisibilityMode mode, const Tile& tile) {
  const bool shader_decides = mode == VisibilityMode::test_only || mode == VisibilityMode::cover_only || draw.kernels.visibility != nullptr;
  return shader_decides && mode != VisibilityMode::early && tests_stencil(draw.state, tile) && updates_stencil(draw.state);
}

}  // namespace

std::span<const PathRow> path_rows() {
  static constexpr PathRow rows[] = {
      {TilePath::nearest, "nearest", "coverage, depth", "less, with writes", "depth, triangle ids of deferred draws"},
      {TilePath::opaque, "opaque", "coverage, depth", "any", "depth, triangle ids of deferred draws"},
      {TilePath::stencil, "stencil", "coverage, depth, stencil test, bounds of the stored depth", "any",
       "depth, stencil values, triangle ids of deferred draws"},
      {TilePath::queued, "queued", "the shader, the order of execution, or a stencil test after the shader", "any",
       "queue of packets; depth if no test follows the shader"},
      {TilePath::queued_less, "queued_less", "the shader", "less, tested before and after the shader", "queue of packets"},
      {TilePath::queued_stencil, "queued_stencil", "a stencil test or bounds of the stored depth before the shader, then as above", "any",
       "queue of packets; depth and stencil values if no test follows the shader"},
  };
  return rows;
}

TilePath choose_path(const Draw& draw, VisibilityMode mode, const Tile& tile) {
  const DepthState& depth = draw.state.depth;
  const bool tests = tests_depth(depth, tile), is_less = tests && depth.compare == CompareOp::less;
  // The paths with a stencil test also test the bounds of the stored depth.
  const bool has_stencil =
      tests_stencil(draw.state, tile) || (tests_stored_depth(draw.state, tile) && (shades_later(mode) || mode == VisibilityMode::early));
  const bool shader_decides = !shades_later(mode) || draw.kernels.visibility != nullptr;
  if (!shader_decides) {
    if (has_stencil) return TilePath::stencil;
    return is_less && depth.write ? TilePath::nearest : TilePath::opaque;
  }
  if (postpones_stencil(draw, mode, tile)) return TilePath::queued;
  if (has_stencil) return TilePath::queued_stencil;
  const bool tests_twice = mode != VisibilityMode::early && mode != VisibilityMode::cover_only && !draw.kernels.writes_depth;
  return is_less && tests_twice ? TilePath::queued_less : TilePath::queued;
}

DrawInTile::DrawInTile(const PassContext& f, const Draw& d, VisibilityMode m, Tile& t, TileTrace* tile_trace)
    : context(f),
      draw(d),
      mode(m),
      path(choose_path(d, m, t)),
      tile(t),
      bounds{std::max(d.bounds.x0, t.x0), std::max(d.bounds.y0, t.y0), std::min(d.bounds.x1, t.x0 + t.width),
             std::min(d.bounds.y1, t.y0 + t.height)},
      needs_bounds_test(bounds != PixelBounds{t.x0, t.y0, t.x0 + t.size, t.y0 + t.size}),
      tests(tests_depth(d.state.depth, t)),
      postpones_stencil(HS_LANES::postpones_stencil(d, m, t)),
      fetches_vertices(fetches_vertices_ahead(d, m)),
      trace(tile_trace) {}

Mask depth_test(const DepthState& state, const Tile& tile, int packet, Real z, Mask mask) {
  if (!tests_depth(state, tile)) return mask;
  return mask & compare(state.compare, z, load<Real>(&tile.depth[static_cast<std::size_t>(packet) * kLanes]));
}

void write_depth(const DepthState& state, Tile& tile, int packet, Real z, Mask mask) {
  if (!tests_depth(state, tile) || !state.write) return;
  float* stored = &tile.depth[static_cast<std::size_t>(packet) * kLanes];
  store(stored, select(mask, z, load<Real>(stored)));
  const auto block = static_cast<std::size_t>(packet / kPacketsPerBlock);
  // The shader may have written any depth. The bounds decide nothing until they are recomputed.
  tile.hiz_min[block] = std::numeric_limits<float>::lowest();
  tile.hiz_max[block] = std::numeric_limits<float>::max();
  tile.hiz_is_stale[block] = true;
}

}  // namespace halfspace::HS_LANES
