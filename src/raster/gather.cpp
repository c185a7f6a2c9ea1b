// SPDX-License-Identifier: Apache-2.0
//
// The triangles of a packet that shows many, brought into lanes.
#include <bit>

#include "raster/lane_order.h"
#include "raster/shade.h"
#include "raster/triangle_records.h"

namespace halfspace {

namespace {

// Lane by lane the triangle of ids; where `lanes` has none, the first that there is.
std::array<const Triangle*, kLanes> triangles_of(const Frame& frame, const TriangleId* ids, uint32_t lanes) {
  const TriangleId first = ids[std::countr_zero(lanes)];
  std::array<const Triangle*, kLanes> triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const TriangleId id = (lanes >> i & 1) != 0 ? ids[i] : first;
    triangles[i] = &frame.chunks[id >> 16].triangles[id & 0xffff];
  }
  return triangles;
}

void find_primitives(const Frame& frame, const TriangleId* ids, uint32_t lanes, const Draw& draw, TriangleRows& rows) {
  const auto length = static_cast<std::size_t>(draw.kernels.primitive_count);
  if (length == 0) return;
  for (std::size_t i = 0; i < rows.primitive.size(); ++i) {
    const TriangleId id = (lanes >> i & 1) != 0 ? ids[i] : ids[std::countr_zero(lanes)];
    const Chunk& chunk = frame.chunks[id >> 16];
    const uint32_t index = id & 0xffff;
    const Segment& segment = chunk.segments[chunk.triangles[index].segment()];
    rows.primitive[i] = chunk.primitives.data() + segment.first_primitive + (index - segment.first_triangle) * length;
  }
}

}  // namespace

bool gather_rows(const Frame& frame, const TriangleId* ids, uint32_t lanes, TriangleLanes<Real>& triangles, Mask& front,
                 TriangleRows& rows) {
  const Draw& draw = draw_of(frame, ids[std::countr_zero(lanes)]);
  const ShadedVertices& shaded = frame.shaded[static_cast<std::size_t>(&draw - frame.draws.data())];
  if (!can_gather(shaded, draw)) return false;
  const std::array<const Triangle*, kLanes> at = triangles_of(frame, ids, lanes);
  const auto triangle = [&](int k) { return at[static_cast<std::size_t>(k)]; };
  const std::array<Int, 4> ends = load_vertices_and_flags(triangle);
  const Int flags = ends[3];
  if (any((flags & Int(static_cast<int32_t>(kClipped | kSprite | kLine))) != Int(0))) return false;
  find_primitives(frame, ids, lanes, draw, rows);
  auto [x, y] = load_corners(triangle);
  rows.varyings = shaded.varyings.get();
  rows.row = {ends[0], ends[1], ends[2]};
  const Int provoking = (flags >> static_cast<int>(kProvokingShift)) & 3;
  rows.provoking_row = select(provoking == Int(0), ends[0], select(provoking == Int(1), ends[1], ends[2]));
  front = (flags & Int(static_cast<int32_t>(kFrontFacing))) != Int(0);
  static_assert(sizeof(ScreenVertex) == 4 * sizeof(float));
  const float* inv_w = &shaded.screen[0].inv_w;
  std::array<Real, 3> q;
  for (std::size_t k = 0; k < 3; ++k) q[k] = gather(inv_w, rows.row[k] << 2);
  // Vertex 0 is the one with the smallest 1/w, the first of equals, as in triangle_scalars.
  const Mask two = (q[2] < q[0]) & (q[2] < q[1]), one = (q[1] < q[0]) & !two;
  rotate_lanes(one, two, x);
  rotate_lanes(one, two, y);
  rotate_lanes(one, two, q);
  rotate_lanes(one, two, rows.row);
  const detail::ScaledInverseW<Real> w = detail::scaled(q[0], q[1], q[2]);
  const auto real = [](Int i) { return to_real<Real>(i); };
  triangles = {real(x[0]), real(y[0]), real(x[1] - x[0]), real(y[1] - y[0]), real(x[2] - x[0]), real(y[2] - y[0]), Real(0.0f), w.q0,
               w.q1,       w.q2,       w.unscale};
  triangles.area = difference_of_products(triangles.e1x, triangles.e2y, triangles.e1y, triangles.e2x);
  return true;
}

}  // namespace halfspace
