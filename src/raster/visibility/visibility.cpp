// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/visibility.h"

#include <algorithm>
#include <limits>

#include "halfspace/raster/visibility/depth_bounds.h"
#include "halfspace/raster/visibility/depth_stencil_test.h"

namespace halfspace {

namespace {

bool tests_depth(const DepthState& state, const Tile& tile) { return state.test && tile.depth_format != DepthFormat::none; }

}  // namespace

VisibilityMode visibility_mode(const Draw& draw) {
  if (draw.deferred) return VisibilityMode::deferred;
  if (draw.kernels.fragment == nullptr) return VisibilityMode::depth_only;
  const bool needs_fragments = draw.state.alpha_to_coverage || draw.state.order_independent;
  const bool is_undecided = (draw.kernels.discards || draw.kernels.writes_depth) && draw.kernels.visibility == nullptr;
  if (!draw.writes_color && !needs_fragments && !is_undecided) return VisibilityMode::depth_only;
  if (draw.kernels.writes_depth) return VisibilityMode::cover_only;
  if (draw.kernels.discards || draw.state.alpha_to_coverage || draw.state.order_independent) return VisibilityMode::test_only;
  return VisibilityMode::early;
}

namespace {

// Returns true if a deferred draw benefits from prefetching its vertices. Triangles that share vertices do, because each vertex is used
// several times. Points do, because the points of a tile are scattered in memory.
bool fetches_vertices_ahead(const Draw& draw) {
  if (draw.kernels.fragment == nullptr || draw.kernels.varying_count == 0) return false;
  return draws_points(draw.state) || draw.indices->used_count() < draw.primitive_count;
}

// Returns true if the shader does not take part in visibility. The members before is_opaque must be set.
bool draws_without_shader(const DrawInTile& d) {
  const bool shades_later = d.mode == VisibilityMode::deferred || d.mode == VisibilityMode::depth_only;
  return shades_later && !d.runs_visibility_function && (d.tile.samples > 1 || (d.draw.sample_mask & 1) != 0);
}

}  // namespace

DrawInTile::DrawInTile(const PassContext& f, const Draw& d, VisibilityMode m, Tile& t)
    : context(f),
      draw(d),
      mode(m),
      tile(t),
      bounds{std::max(d.bounds.x0, t.x0), std::max(d.bounds.y0, t.y0), std::min(d.bounds.x1, t.x0 + t.width),
             std::min(d.bounds.y1, t.y0 + t.height)},
      needs_bounds_test(t.size != kMaxTileSize || bounds.x0 > t.x0 || bounds.y0 > t.y0 || d.bounds.x1 < t.x0 + t.size ||
                        d.bounds.y1 < t.y0 + t.size),
      tests(tests_depth(d.state.depth, t)),
      runs_visibility_function((m == VisibilityMode::deferred || m == VisibilityMode::depth_only) && d.kernels.visibility != nullptr),
      fetches_vertices(m == VisibilityMode::deferred && fetches_vertices_ahead(d)),
      is_opaque(draws_without_shader(*this) && !(d.state.stencil && t.has_stencil)),
      has_stencil(draws_without_shader(*this) && d.state.stencil && t.has_stencil && t.samples == 1),
      is_queued(!is_opaque && (t.samples == 1 ? (d.sample_mask & 1) != 0 : !d.shades_samples) && !(d.state.stencil && t.has_stencil)) {}

Mask depth_test(const DepthState& state, const Tile& tile, int packet, Real z, Mask mask) {
  if (!tests_depth(state, tile)) return mask;
  return mask & compare(state.compare, z, load<Real>(&tile.depth[static_cast<std::size_t>(packet) * kLanes]));
}

void write_depth(const DepthState& state, Tile& tile, int packet, Real z, Mask mask) {
  if (!tests_depth(state, tile) || !state.write) return;
  float* stored = &tile.depth[static_cast<std::size_t>(packet) * kLanes];
  store(stored, select(mask, z, load<Real>(stored)));
  const auto block = static_cast<std::size_t>(packet / kPacketsPerBlock);
  // The shader may have written any depth. The bounds are recomputed before the next test.
  tile.hiz_min[block] = std::numeric_limits<float>::lowest();
  tile.hiz_max[block] = std::numeric_limits<float>::max();
  tile.hiz_writes[block] = kRefreshAfter;
}

}  // namespace halfspace
