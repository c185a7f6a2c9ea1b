// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/setup_scalar.h"

#include <algorithm>
#include <cmath>

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/primitives/tiny_coverage.h"

namespace halfspace::HS_LANES {

namespace {

// Returns the smallest resolvable depth difference (OpenGL 4.6, section 14.6.5).
double smallest_depth_step(DepthFormat format, float largest_z) {
  switch (format) {
    case DepthFormat::d16: return 1.0 / 65535.0;
    case DepthFormat::d24: return 1.0 / 16777215.0;
    default: return std::ldexp(1.0, (std::fabs(largest_z) > 0.0f ? std::ilogb(largest_z) : -126) - 23);
  }
}

struct DepthDifferences {
  double dz1, dz2;  // depth of vertices 1 and 2 relative to vertex 0
  double area;      // in (1/256 px)²
};

float depth_offset(const DepthOffset& o, DepthFormat format, const Triangle& t, const DepthDifferences& p, float largest_z) {
  if (o.slope == 0.0f && o.constant == 0.0f) return 0.0f;
  double offset = 0.0;
  if (o.slope != 0.0f) {  // skipped for a slope factor of 0, because 0·Inf would be NaN
    const double e1x = t.x[1] - t.x[0], e1y = t.y[1] - t.y[0], e2x = t.x[2] - t.x[0], e2y = t.y[2] - t.y[0];
    const double dz_dx = (e2y * p.dz1 - e1y * p.dz2) / p.area * kSubPixels;
    const double dz_dy = (e1x * p.dz2 - e2x * p.dz1) / p.area * kSubPixels;
    offset += static_cast<double>(o.slope) * std::max(std::fabs(dz_dx), std::fabs(dz_dy));
  }
  offset += static_cast<double>(o.constant) * smallest_depth_step(format, largest_z);
  if (o.clamp > 0.0f) offset = std::min(offset, static_cast<double>(o.clamp));
  if (o.clamp < 0.0f) offset = std::max(offset, static_cast<double>(o.clamp));
  return static_cast<float>(offset);
}

bool is_narrow(const Triangle& t) { return max_of(t.x) - min_of(t.x) <= kNarrowExtent && max_of(t.y) - min_of(t.y) <= kNarrowExtent; }

}  // namespace

Cull set_up_triangle(const Draw& draw, const PassContext& context, const std::array<const ScreenVertex*, 3>& v,
                     const std::array<uint32_t, 3>& index, uint32_t provoking, Facing facing, Triangle& out) {
  const int64_t e1x = v[1]->x - v[0]->x, e1y = v[1]->y - v[0]->y;
  const int64_t e2x = v[2]->x - v[0]->x, e2y = v[2]->y - v[0]->y;
  const int64_t area = e1x * e2y - e1y * e2x;
  if (area == 0) return Cull::degenerate;
  bool front = facing != Facing::back;
  if (facing == Facing::by_winding) {
    front = is_front(draw.state, area > 0);
    if (is_culled(draw.state.cull, front)) return Cull::face;
  }

  // Put the vertices in counter-clockwise order, starting with the smallest depth.
  std::array<std::size_t, 3> order{0, 1, 2};
  if (area < 0) std::swap(order[1], order[2]);
  const float z_min = std::min({v[0]->z, v[1]->z, v[2]->z});
  while (v[order[0]]->z != z_min) std::rotate(order.begin(), order.begin() + 1, order.end());

  for (std::size_t i = 0; i < 3; ++i) {
    out.x[i] = v[order[i]]->x;
    out.y[i] = v[order[i]]->y;
    out.vertex[i] = index[order[i]];
    if (order[i] == provoking) out.flags = static_cast<uint32_t>(i) << kProvokingShift;
  }
  const PixelBounds box = draw.is_smooth ? pixel_bounds(draw, out, draw.bounds, context.samples_at)
                                         : intersect(pixel_box(out.x, out.y, context.samples_at, context.samples_at), draw.bounds);
  if (box.empty()) return Cull::no_sample;
  const bool may_be_narrow = !draw.is_smooth && is_narrow(out);  // loops over narrow triangles test samples
  const bool few = context.samples == 1 && may_be_narrow && box.fits_in(kTinySide, kTinySide);
  const int32_t covered = few ? covered_centers<float>(out.x, out.y, box) : 0;
  if (few && covered == 0) return Cull::no_sample;

  const DepthDifferences plane{static_cast<double>(v[order[1]]->z) - static_cast<double>(z_min),
                               static_cast<double>(v[order[2]]->z) - static_cast<double>(z_min), std::fabs(static_cast<double>(area))};
  const float z_max = std::max({v[0]->z, v[1]->z, v[2]->z});
  const bool is_moved = facing == Facing::by_winding && has_offset(draw.state.offset, PolygonMode::fill);
  const float offset =
      !is_moved ? 0.0f : depth_offset(draw.state.offset, context.depth_format, out, plane, std::max(std::fabs(z_min), std::fabs(z_max)));
  out.z0 = z_min + offset;
  out.z_max = z_max + offset;
  out.z_edge1 = static_cast<float>(plane.dz1 / plane.area);
  out.z_edge2 = static_cast<float>(plane.dz2 / plane.area);

  if (may_be_narrow) out.flags |= kNarrow;
  out.flags |= static_cast<uint32_t>(covered_flags(box, covered));
  if (front) out.flags |= kFrontFacing;
  return Cull::none;
}

float outline_offset(const DepthOffset& offset, DepthFormat format, const std::array<const ScreenVertex*, 3>& v) {
  Triangle t;
  for (std::size_t i = 0; i < 3; ++i) t.x[i] = v[i]->x, t.y[i] = v[i]->y;
  const int64_t area = int64_t{t.x[1] - t.x[0]} * (t.y[2] - t.y[0]) - int64_t{t.y[1] - t.y[0]} * (t.x[2] - t.x[0]);
  const auto z = [&](std::size_t i) { return static_cast<double>(v[i]->z); };
  const float largest_z = std::max({std::fabs(v[0]->z), std::fabs(v[1]->z), std::fabs(v[2]->z)});
  return depth_offset(offset, format, t, {z(1) - z(0), z(2) - z(0), static_cast<double>(area)}, largest_z);
}

}  // namespace halfspace::HS_LANES
