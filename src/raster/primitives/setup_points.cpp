// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/setup_points.h"

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/window.h"

namespace halfspace::HS_LANES {

namespace {

// Same as append_point(), for the loop over the points of a draw. It is inlined, because a call per point would make points_100k 1 %
// slower.
HS_INLINE Cull add_point(SetupRange& r, const PointSpriteRect& rect, const ScreenVertex& v, uint32_t id, uint32_t flags, Facing facing) {
  if (rect.x0 >= rect.x1 || rect.y0 >= rect.y1) return Cull::degenerate;
  if (facing != Facing::back) flags |= kFrontFacing;
  Triangle t{.x = {rect.x0, rect.x1 - 1, rect.x0},
             .y = {rect.y0, rect.y1 - 1, rect.y0},
             .z0 = v.z,
             .z_edge1 = 0,
             .z_edge2 = 0,
             .z_max = v.z,
             .vertex = {id, id, id},
             .flags = kPointSprite | kNarrow};
  const bool is_empty = pixel_bounds(r.draw, t, r.draw.bounds, r.context.samples_at).empty();
  return r.append(is_empty ? Cull::no_sample : Cull::none, t, flags);
}

void submit_point(SetupRange& r) {
  const uint32_t id = r.next_slots()[0];
  const Outcode code = r.shaded.outcodes[id];
  const float inv_w = r.shaded.screen[id].inv_w;
  if (code & kOutNonFinite) {
    ++r.chunk.statistics.culled_non_finite;
  } else if ((code & (kOutNear | kOutFar)) != 0 || !(inv_w > 0.0f && inv_w <= 1.0f / kMinW) || r.beyond_distances(id) != 0) {
    ++r.chunk.statistics.culled_outside;
  } else {
    r.count(add_point(r, r.shaded.sprites[id], r.shaded.screen[id], id, 0, Facing::front));
  }
}

}  // namespace

void set_up_points(SetupRange& range, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) {
    submit_point(range);
    range.record_primitive(i);
  }
}

Cull append_point(SetupRange& r, const PointSpriteRect& rect, const ScreenVertex& v, uint32_t id, uint32_t flags, Facing facing) {
  return add_point(r, rect, v, id, flags, facing);
}

}  // namespace halfspace::HS_LANES
