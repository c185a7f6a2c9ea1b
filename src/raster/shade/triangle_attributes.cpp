// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/triangle_attributes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/pipeline/triangle_lanes.h"
#include "halfspace/raster/visibility/sink/centroid.h"

namespace halfspace::HS_LANES {

namespace {

// Returns the triangle that is used for interpolation on a point sprite, with the depth and w of the point at all vertices. The point
// coordinate s increases from 0 to 1 between the first and second vertex, t between the first and third.
std::array<ScreenVertex, 3> point_sprite_corners(const Triangle& t, const ScreenVertex& point, PointOrigin origin) {
  PointSpriteRect r = t.sprite();
  if (origin == PointOrigin::upper_left) std::swap(r.y0, r.y1);
  return {ScreenVertex{r.x0, r.y0, point.z, point.inv_w}, {r.x1, r.y0, point.z, point.inv_w}, {r.x0, r.y1, point.z, point.inv_w}};
}

// Finds the vertices of a clipped triangle, a point or a line.
void find_slow_vertices(const PassContext& context, const Chunk& chunk, const DrawRange& range, const Draw& draw, TriangleSource& s) {
  const Triangle& t = *s.triangle;
  for (std::size_t i = 0; i < (t.is_line() ? 2u : 3u); ++i) {
    if (t.is(kClipped)) {
      const ClipVertex& v = chunk.clip_vertices[t.vertex[i]];
      s.vertex[i] = &v.screen;
      s.varyings[i] = chunk.clip_varyings.data() + v.first_varying;
    } else {
      const ShadedVertices& shaded = context.shaded[range.draw];
      s.vertex[i] = &shaded.screen[t.vertex[i]];
      s.varyings[i] = shaded.varyings.get() + std::size_t{t.vertex[i]} * static_cast<std::size_t>(shaded.varying_count);
    }
  }
  if (t.is_point()) {
    s.corners = point_sprite_corners(t, *s.vertex[0], draw.state.point_origin);
    for (std::size_t i = 0; i < 3; ++i) s.vertex[i] = &s.corners[i];
  }
  if (t.is_line()) {  // the third vertex is next to the first and has the same values
    s.corners[2] = {t.x[2], t.y[2], s.vertex[0]->z, s.vertex[0]->inv_w};
    s.vertex[2] = &s.corners[2];
    s.varyings[2] = s.varyings[0];
  }
}

// Returns the triangle of each lane. Lanes that are not in `lanes` repeat the first one.
std::array<const Triangle*, kLanes> triangles_of(const PassContext& context, const TriangleId* ids, uint32_t lanes) {
  const TriangleId first = ids[std::countr_zero(lanes)];
  std::array<const Triangle*, kLanes> triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const TriangleId id = (lanes >> i & 1) != 0 ? ids[i] : first;
    triangles[i] = &triangle_of(context, id);
  }
  return triangles;
}

void find_primitives(const PassContext& context, const TriangleId* ids, uint32_t lanes, const Draw& draw, TriangleRows& rows) {
  const auto length = static_cast<std::size_t>(draw.kernels.primitive_count);
  if (length == 0) return;
  for (std::size_t i = 0; i < rows.primitive.size(); ++i) {
    const TriangleId id = (lanes >> i & 1) != 0 ? ids[i] : ids[std::countr_zero(lanes)];
    const Chunk& chunk = context.chunks[chunk_of(id)];
    const uint32_t index = index_in_chunk(id);
    const DrawRange& range = chunk.ranges[chunk.triangles[index].range()];
    rows.primitive[i] = chunk.primitives.data() + range.first_primitive + (index - range.first_triangle) * length;
  }
}

}  // namespace

void find_triangle(const PassContext& context, TriangleId id, TriangleSource& s) {
  const Chunk& chunk = context.chunks[chunk_of(id)];
  const uint32_t index = index_in_chunk(id);
  const Triangle& t = chunk.triangles[index];
  const DrawRange& range = chunk.ranges[t.range()];
  const Draw& draw = context.draws[range.draw];
  s.triangle = &t;
  s.primitive = nullptr;
  if (t.is(kClipped | kPointSprite | kLine)) {
    find_slow_vertices(context, chunk, range, draw, s);
  } else {
    const ShadedVertices& shaded = context.shaded[range.draw];
    for (std::size_t i = 0; i < 3; ++i) {
      s.vertex[i] = &shaded.screen[t.vertex[i]];
      s.varyings[i] = shaded.varyings.get() + std::size_t{t.vertex[i]} * static_cast<std::size_t>(shaded.varying_count);
    }
  }
  s.flat_varyings = s.varyings[t.provoking()];
  if (draw.kernels.primitive_count != 0) {
    const std::size_t row = index - range.first_triangle;
    s.primitive = chunk.primitives.data() + range.first_primitive + row * static_cast<std::size_t>(draw.kernels.primitive_count);
  }
}

PlaneAnchor plane_anchor_of(const TriangleSource& s, const PlaneCell& cell) {
  std::array<PlaneCorner, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = {s.vertex[i]->x, s.vertex[i]->y, s.vertex[i]->inv_w};
  return plane_anchor(corners, cell);
}

Real packet_depth(Real x, Real y, const PacketTriangleIds& packet) noexcept {
  Real z(0.0f);
  if (packet.lanes == 0) return z;
  const Real x_sub = x * Real(kSubPixels), y_sub = y * Real(kSubPixels);
  const auto first_id = [&](uint32_t lanes) { return packet.ids == nullptr ? packet.uniform_id : packet.ids[std::countr_zero(lanes)]; };
  const Draw& draw = draw_of(*packet.context, first_id(packet.lanes));  // the same for all lanes
  for (uint32_t rest = packet.lanes; rest != 0;) {
    const TriangleId id = first_id(rest);
    const Mask shows = packet.ids == nullptr ? Mask(true) : load<Int>(packet.ids) == Int(std::bit_cast<int32_t>(id));
    rest &= ~bits(shows);
    const Triangle& t = triangle_of(*packet.context, id);
    const auto edge = [](int32_t to, int32_t from) { return Real(static_cast<float>(to - from)); };
    const Real dx = x_sub - Real(static_cast<float>(t.x[0])), dy = y_sub - Real(static_cast<float>(t.y[0]));
    const Real e1 = difference_of_products(dx, edge(t.y[2], t.y[0]), dy, edge(t.x[2], t.x[0]));
    const Real e2 = difference_of_products(edge(t.x[1], t.x[0]), dy, edge(t.y[1], t.y[0]), dx);
    const float z_low = t.is_line() || draw.is_smooth ? clamp(t.z0, draw.depth_low, draw.depth_high) : draw.depth_low;
    const float z_high = clamp(t.z_max, draw.depth_low, draw.depth_high);
    z = select(shows, clamp(fma(e1, Real(t.z_edge1), fma(e2, Real(t.z_edge2), Real(t.z0))), Real(z_low), Real(z_high)), z);
  }
  return z;
}

namespace {

// Returns the samples of the pixel of a position that a triangle covers. The position is that of a sample if the draw shades each sample.
int32_t sample_mask(const PassContext& context, TriangleId id, float x, float y) {
  const Triangle& t = triangle_of(context, id);
  const Draw& draw = draw_of(context, id);
  const float pixel_x = std::floor(x), pixel_y = std::floor(y);
  const SamplePosition at{static_cast<int>((x - pixel_x) * kSubPixels), static_cast<int>((y - pixel_y) * kSubPixels)};
  uint32_t mask = 0;
  for (int s = 0; s < context.samples; ++s) {
    const SamplePosition p = sample_position(context.samples, s);
    if (draw.shades_samples && (p.x != at.x || p.y != at.y)) continue;
    const bool covers =
        covers_sample(t, static_cast<int64_t>(pixel_x) * kSubPixels + p.x, static_cast<int64_t>(pixel_y) * kSubPixels + p.y);
    mask |= (covers ? 1u : 0u) << s;
  }
  return static_cast<int32_t>(mask & draw.sample_mask);
}

}  // namespace

Int packet_sample_mask(Real x, Real y, const PacketTriangleIds& packet) noexcept {
  Int mask(1);
  if (packet.context->samples == 1) return mask;
  for (uint32_t rest = packet.lanes; rest != 0; rest &= rest - 1) {
    const int i = std::countr_zero(rest);
    set_lane(mask, i, sample_mask(*packet.context, packet.ids == nullptr ? packet.uniform_id : packet.ids[i], lane(x, i), lane(y, i)));
  }
  return mask;
}

namespace {

// Vertices of a different triangle in each lane.
struct VertexLanes {
  std::array<Int, 3> x, y;
  std::array<Real, 3> inv_w;
};

// Loads vertex k of each lane from a row of `screen`.
void load_vertex(const ShadedVertices& shaded, Int row, std::size_t k, VertexLanes& out) {
  static_assert(sizeof(ScreenVertex) == 4 * sizeof(float));
  std::array<int32_t, kLanes> vertex;
  store(vertex.data(), row);
  const auto words =
      load_aos4<Int>([&](int lane) { return &shaded.screen[static_cast<std::size_t>(vertex[static_cast<std::size_t>(lane)])]; });
  out.x[k] = words[0];
  out.y[k] = words[1];
  out.inv_w[k] = as_real(words[3]);
}

// Replaces the vertices with those of point sprites; see point_sprite_corners(). triangle(lane): the point.
template <class F>
void set_point_corners(const F& triangle, PointOrigin origin, VertexLanes& v) {
  const auto [x, y] = load_corners(triangle);
  const bool is_upper = origin == PointOrigin::upper_left;
  const Int low = y[0], high = y[1] + 1;
  v.x = {x[0], x[1] + 1, x[0]};
  v.y = {is_upper ? high : low, is_upper ? high : low, is_upper ? low : high};
  v.inv_w[1] = v.inv_w[2] = v.inv_w[0];
}

// Sets the third vertex of lines, which is next to the first one. triangle(lane): the line.
template <class F>
void set_line_corner(const F& triangle, VertexLanes& v) {
  const auto [x, y] = load_corners(triangle);
  v.x[2] = x[2];
  v.y[2] = y[2];
  v.inv_w[2] = v.inv_w[0];
}

}  // namespace

bool gather_rows(const PassContext& context, const TriangleId* ids, uint32_t lanes, TriangleLanes<Real>& triangles, Mask& front,
                 TriangleRows& rows) {
  const Draw& draw = draw_of(context, ids[std::countr_zero(lanes)]);
  const ShadedVertices& shaded = context.shaded[static_cast<std::size_t>(&draw - context.draws.data())];
  if (!can_gather(shaded, draw)) return false;
  const std::array<const Triangle*, kLanes> at = triangles_of(context, ids, lanes);
  const auto triangle = [&](int k) { return at[static_cast<std::size_t>(k)]; };
  const std::array<Int, 4> ends = load_vertices_and_flags(triangle);
  const Int flags = ends[3];
  if (any((flags & Int(static_cast<int32_t>(kClipped))) != Int(0))) return false;
  const bool points = at[0]->is_point(), lines = at[0]->is_line();  // the same for all primitives of a draw
  find_primitives(context, ids, lanes, draw, rows);
  rows.varyings = shaded.varyings.get();
  rows.row = {ends[0], ends[1], lines ? ends[0] : ends[2]};
  const Int provoking = (flags >> static_cast<int>(kProvokingShift)) & 3;
  rows.provoking_row = select(provoking == Int(0), ends[0], select(provoking == Int(1), ends[1], ends[2]));
  front = (flags & Int(static_cast<int32_t>(kFrontFacing))) != Int(0);
  VertexLanes v;
  for (std::size_t k = 0; k < (points ? 1u : lines ? 2u : 3u); ++k) load_vertex(shaded, rows.row[k], k, v);
  if (points) set_point_corners(triangle, draw.state.point_origin, v);
  if (lines) set_line_corner(triangle, v);
  auto& [x, y, q] = v;
  const Mask may_have_planes = (flags & Int(static_cast<int32_t>(kNarrow | kPointSprite | kLine))) == Int(0);
  if (any(may_have_planes & (q[0] == q[1]) & (q[0] == q[2]))) return false;
  // Vertex 0 is the one with the smallest 1/w, or the first of several, as in triangle_scalars().
  const Mask two = (q[2] < q[0]) & (q[2] < q[1]), one = (q[1] < q[0]) & !two;
  rotate_lanes(one, two, x);
  rotate_lanes(one, two, y);
  rotate_lanes(one, two, q);
  rotate_lanes(one, two, rows.row);
  const detail::ScaledInverseW<Real> w = detail::scaled(q[0], q[1], q[2]);
  const auto real = [](Int i) { return to_real<Real>(i); };
  triangles = {real(x[0]), real(y[0]), real(x[1] - x[0]), real(y[1] - y[0]), real(x[2] - x[0]), real(y[2] - y[0]), Real(0.0f), w.q0,
               w.q1,       w.q2,       w.unscale,         Mask(false)};
  triangles.area = difference_of_products(triangles.e1x, triangles.e2y, triangles.e1y, triangles.e2x);
  return true;
}

}  // namespace halfspace::HS_LANES
