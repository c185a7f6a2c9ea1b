// SPDX-License-Identifier: Apache-2.0
//
// The triangles of a packet that shows many, brought into lanes.
#include <bit>

#include "raster/lane_order.h"
#include "raster/shade.h"

namespace halfspace {

namespace {

// The records of a packet's triangles, field by field.
struct Records {
  alignas(64) std::array<std::array<int32_t, kLanes>, 3> x, y, vertex;
  alignas(64) std::array<int32_t, kLanes> provoking, front;
};

bool copy_records(const Frame& frame, const TriangleId* ids, uint32_t lanes, Records& r, TriangleRows& rows) {
  const TriangleId first = ids[std::countr_zero(lanes)];
  for (std::size_t i = 0; i < static_cast<std::size_t>(kLanes); ++i) {
    const TriangleId id = (lanes >> i & 1) != 0 ? ids[i] : first;
    const Chunk& chunk = frame.chunks[id >> 16];
    const uint32_t index = id & 0xffff;
    const Triangle& t = chunk.triangles[index];
    if (t.is(kClipped | kSprite | kLine)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      r.x[k][i] = t.x[k];
      r.y[k][i] = t.y[k];
      r.vertex[k][i] = static_cast<int32_t>(t.vertex[k]);
    }
    r.provoking[i] = static_cast<int32_t>(t.vertex[t.provoking()]);
    r.front[i] = t.is(kFrontFacing) ? 1 : 0;
    const Segment& segment = chunk.segments[t.segment()];
    const auto row_length = static_cast<std::size_t>(frame.draws[segment.draw].kernels.primitive_count);
    if (row_length != 0)
      rows.primitive[i] = chunk.primitives.data() + segment.first_primitive + (index - segment.first_triangle) * row_length;
  }
  return true;
}

}  // namespace

bool gather_rows(const Frame& frame, const TriangleId* ids, uint32_t lanes, TriangleLanes<Real>& triangles, Mask& front,
                 TriangleRows& rows) {
  const Draw& draw = draw_of(frame, ids[std::countr_zero(lanes)]);
  const ShadedVertices& shaded = frame.shaded[static_cast<std::size_t>(&draw - frame.draws.data())];
  Records r;
  if (!can_gather(shaded, draw) || !copy_records(frame, ids, lanes, r, rows)) return false;
  rows.varyings = shaded.varyings.get();
  rows.provoking_row = load<Int>(r.provoking.data());
  front = load<Int>(r.front.data()) != Int(0);
  std::array<Int, 3> x, y;
  std::array<Real, 3> q;
  static_assert(sizeof(ScreenVertex) == 4 * sizeof(float));
  const float* inv_w = &shaded.screen[0].inv_w;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = load<Int>(r.x[k].data());
    y[k] = load<Int>(r.y[k].data());
    rows.row[k] = load<Int>(r.vertex[k].data());
    q[k] = gather(inv_w, rows.row[k] << 2);
  }
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
