// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/append_lines.h"

#include <algorithm>
#include <cmath>

#include "halfspace/raster/pipeline/line.h"
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/window.h"
#include "halfspace/raster/primitives/clip.h"

namespace halfspace::HS_LANES {

namespace {

// Sets up a line from two snapped vertices, for passes with one sample per pixel. See set_up_triangle() for the arguments.
Cull set_up_line(const Draw& draw, const PassContext& context, const std::array<const ScreenVertex*, 2>& v,
                 const std::array<uint32_t, 2>& index, uint32_t provoking, Facing facing, Triangle& out) {
  const LineRange range = line_range(*v[0], *v[1], line_pixels(draw.state.line_width));
  const std::size_t near = v[1]->z < v[0]->z ? 1 : 0;
  const ScreenVertex &a = *v[near], &b = *v[1 - near];
  const int32_t dx = b.x - a.x, dy = b.y - a.y;
  if (dx == 0 && dy == 0) return Cull::degenerate;
  out.x = {a.x, b.x, a.x - dy};
  out.y = {a.y, b.y, a.y + dx};
  out.z0 = a.z;
  out.z_max = b.z;
  const double length2 = static_cast<double>(int64_t{dx} * dx + int64_t{dy} * dy);
  out.z_edge1 = static_cast<float>((static_cast<double>(b.z) - static_cast<double>(a.z)) / length2);
  out.z_edge2 = 0.0f;
  out.vertex = {index[near], index[1 - near], range.packed()};
  out.flags = kLine | (provoking == near ? 0u : 1u) << kProvokingShift | (facing == Facing::back ? 0u : kFrontFacing);
  return pixel_bounds(draw, out, draw.bounds, context.samples_at).empty() ? Cull::no_sample : Cull::none;
}

// Returns the corners of the rectangle that represents a multisampled line. As seen in the direction of the line, they are to the right of
// a, to the right of b, to the left of b and to the left of a, which is counter-clockwise order. The end points must differ.
std::array<ScreenVertex, 4> line_rectangle(const ScreenVertex& a, const ScreenVertex& b, float width) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double scale = static_cast<double>(std::clamp(width, 0.0f, 4096.0f)) * (kSubPixels / 2) / std::sqrt(dx * dx + dy * dy);
  const auto nx = static_cast<int32_t>(std::nearbyint(-dy * scale)), ny = static_cast<int32_t>(std::nearbyint(dx * scale));
  return {ScreenVertex{a.x - nx, a.y - ny, a.z, a.inv_w},
          {b.x - nx, b.y - ny, b.z, b.inv_w},
          {b.x + nx, b.y + ny, b.z, b.inv_w},
          {a.x + nx, a.y + ny, a.z, a.inv_w}};
}

}  // namespace

Cull append_line(SetupRange& r, const std::array<const ScreenVertex*, 2>& v, const std::array<uint32_t, 2>& index, uint32_t flags,
                 uint32_t provoking, Facing facing) {
  Triangle t;
  const Cull why = set_up_line(r.draw, r.context, v, index, provoking, facing, t);
  return r.append(why, t, flags);
}

bool can_append_outlines(const SetupRange& r) {
  // Flat varyings have the values of the provoking vertex, which may not belong to the edge, and the primitive id and polygon offsets need
  // clip vertices. Such draws are excluded.
  const ShaderKernels& kernels = r.draw.kernels;
  const std::span modes(kernels.interpolations, static_cast<std::size_t>(kernels.varying_count));
  return r.draw.state.polygon_mode == PolygonMode::line && !has_offset(r.draw.state.offset, PolygonMode::line) && r.context.samples == 1 &&
         !kernels.uses_id && std::ranges::find(modes, Interpolation::flat) == modes.end();
}

void append_outline(SetupRange& r, const PrimitiveSlots& id) {
  const auto vertex = [&](std::size_t i) -> const ScreenVertex& { return r.shaded.screen[id[i % 3]]; };
  const int64_t area = orient2d(vertex(0), vertex(1), vertex(2));
  if (area == 0) return r.count(Cull::degenerate);
  const bool front = is_front(r.draw.state, area > 0);
  if (is_culled(r.draw.state.cull, front)) return r.count(Cull::face);
  const std::size_t before = r.chunk.triangles.size();
  Cull why = Cull::none;
  for (std::size_t i = 0; i < 3; ++i) {
    why = append_line(r, {&vertex(i), &vertex(i + 1)}, {id[i], id[(i + 1) % 3]}, 0, 0, front ? Facing::front : Facing::back);
  }
  if (r.chunk.triangles.size() == before) r.count(why);
}

Cull append_clip_line(SetupRange& r, uint32_t a, uint32_t b, Facing facing) {
  if (r.context.samples == 1) return append_line(r, {&r.clip_vertex(a), &r.clip_vertex(b)}, {a, b}, kClipped, 0, facing);
  const ClipVertex from = r.chunk.clip_vertices[a], to = r.chunk.clip_vertices[b];
  if (from.screen.x == to.screen.x && from.screen.y == to.screen.y) return Cull::degenerate;
  const auto first = static_cast<uint32_t>(r.chunk.clip_vertices.size());
  const std::array<ScreenVertex, 4> corners = line_rectangle(from.screen, to.screen, r.draw.state.line_width);
  for (std::size_t i = 0; i < 4; ++i) {
    r.chunk.clip_vertices.push_back({corners[i], i == 0 || i == 3 ? from.first_varying : to.first_varying});
  }
  const Cull why = r.append_clip_triangle({first, first + 1, first + 2}, facing);
  const Cull other = r.append_clip_triangle({first, first + 2, first + 3}, facing);
  return why == Cull::none ? why : other;
}

}  // namespace halfspace::HS_LANES
