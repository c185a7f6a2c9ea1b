// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/visibility.h"

#include <algorithm>
#include <limits>

#include "halfspace/raster/visibility/depth_bounds.h"
#include "halfspace/raster/visibility/depth_stencil_test.h"

namespace halfspace::HS_LANES {

VisibilityMode visibility_mode(const Draw& draw) {
  if (draw.deferred) return VisibilityMode::deferred;
  if (draw.kernels.fragment == nullptr) return VisibilityMode::depth_only;
  const bool needs_fragments = draw.covers_by_alpha || draw.state.order_independent;
  const bool is_undecided = (draw.kernels.discards || draw.kernels.writes_depth) && draw.kernels.visibility == nullptr;
  if (!draw.writes_color && !needs_fragments && !is_undecided) return VisibilityMode::depth_only;
  if (draw.kernels.writes_depth) return VisibilityMode::cover_only;
  if (draw.kernels.discards || needs_fragments) return VisibilityMode::test_only;
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

}  // namespace

Rasterizer choose_rasterizer(const Draw& draw, VisibilityMode mode, const Tile& tile) {
  const bool shader_decides = !shades_later(mode) || draw.kernels.visibility != nullptr;
  if (shader_decides) return Rasterizer::queued;
  return tests_stencil(draw.state, tile) ? Rasterizer::stencil : Rasterizer::opaque;
}

DrawInTile::DrawInTile(const PassContext& f, const Draw& d, VisibilityMode m, Tile& t)
    : context(f),
      draw(d),
      mode(m),
      rasterizer(choose_rasterizer(d, m, t)),
      tile(t),
      bounds{std::max(d.bounds.x0, t.x0), std::max(d.bounds.y0, t.y0), std::min(d.bounds.x1, t.x0 + t.width),
             std::min(d.bounds.y1, t.y0 + t.height)},
      needs_bounds_test(bounds != PixelBounds{t.x0, t.y0, t.x0 + t.size, t.y0 + t.size}),
      tests(tests_depth(d.state.depth, t)),
      postpones_stencil(rasterizer == Rasterizer::queued && m != VisibilityMode::early && tests_stencil(d.state, t) &&
                        updates_stencil(d.state)),
      fetches_vertices(fetches_vertices_ahead(d, m)) {}

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
