// SPDX-License-Identifier: Apache-2.0
#include "raster/triangle_batch.h"

#include <bit>

#include "core/fours.h"
#include "raster/lane_order.h"
#include "raster/pixel_box.h"
#include "raster/primitive_setup.h"
#include "raster/sample_cover.h"

namespace halfspace {

bool TriangleBatch::serves(const Draw& draw) {
  const DrawState& s = draw.state;
  return kLanes > 1 && s.polygon_mode == PolygonMode::fill && draw.kernels.clip_distance_count == 0 && s.offset.slope == 0.0f &&
         s.offset.constant == 0.0f;
}

void TriangleBatch::set_up(const Frame& frame, const Draw& draw, const ShadedVertices& shaded, uint32_t lanes, uint32_t provoking,
                           PassStatistics& statistics) {
  static_assert(sizeof(ScreenVertex) == 4 * sizeof(int32_t));
  std::array<Int, 3> v, x, y;
  std::array<Real, 3> z;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = load<Int>(vertex_[i].data());
    const std::array<Int, 4> vertex =
        load_fours<Int>([&](int k) { return &shaded.screen[static_cast<uint32_t>(vertex_[i][static_cast<std::size_t>(k)])]; });
    x[i] = vertex[0];
    y[i] = vertex[1];
    z[i] = as_real(vertex[2]);
  }
  const uint32_t small = bits(largest(x) - least(x) <= Int(kSmallExtent) && largest(y) - least(y) <= Int(kSmallExtent));
  large_ = lanes & ~small;
  lanes &= small;
  // Below 2·kSmallExtent² < 2^29.
  const Int area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
  const Mask turns_left = area > Int(0);
  const Mask turns_right = !turns_left;
  const Mask front = draw.state.front == Winding::counter_clockwise ? turns_left : turns_right;
  const bool culls_front = is_culled(draw.state.cull, true), culls_back = is_culled(draw.state.cull, false);
  const PixelBox<Int> box = cut(pixel_box(x, y, frame.samples_at, frame.samples_at), draw.bounds);
  const auto take = [&](uint32_t which, uint64_t& counter) {
    counter += static_cast<uint64_t>(std::popcount(lanes & which));
    lanes &= ~which;
  };
  take(bits(area == Int(0)), statistics.culled_degenerate);
  take(bits(select(front, Mask(culls_front), Mask(culls_back))), statistics.culled_face);
  take(bits(box.empty()), statistics.culled_no_sample);
  swap_lanes(turns_right, x[1], x[2]);
  swap_lanes(turns_right, y[1], y[2]);
  const Mask few = box.is_at_most(kCoverSide, kCoverSide);
  if (frame.samples == 1 && (bits(few) & lanes) != 0) take(bits(few && !covers_center<Real>(x, y, box)), statistics.culled_no_sample);
  kept_ = lanes;
  if (lanes == 0) return;

  // Order: counter-clockwise, starting at the smallest depth; among equals at the first submitted.
  std::array<Int, 3> order{Int(0), Int(1), Int(2)};
  swap_lanes(turns_right, z[1], z[2]);
  swap_lanes(turns_right, v[1], v[2]);
  swap_lanes(turns_right, order[1], order[2]);
  const Real z_min = least(z), z_max = largest(z);
  const Mask one = (z[0] != z_min) & (z[1] == z_min), two = (z[0] != z_min) & (z[1] != z_min);
  rotate_lanes(one, two, x);
  rotate_lanes(one, two, y);
  rotate_lanes(one, two, z);
  rotate_lanes(one, two, v);
  rotate_lanes(one, two, order);
  for (std::size_t i = 0; i < 3; ++i) {
    store(x_[i].data(), x[i]);
    store(y_[i].data(), y[i]);
    store(vertex_[i].data(), v[i]);
  }
  const Int wanted(static_cast<int32_t>(provoking));
  const Int place = select(order[0] == wanted, Int(0), select(order[1] == wanted, Int(1), Int(2)));
  store(flags_.data(), place << static_cast<int>(kProvokingShift) | Int(static_cast<int32_t>(kSmall)) |
                           select(front, Int(static_cast<int32_t>(kFrontFacing)), Int(0)));
  store(z0_.data(), z[0]);
  store(z_max_.data(), z_max);
  alignas(64) Row areas;
  alignas(64) FloatRow z1, z2;
  store(areas.data(), max(area, -area));
  store(z1.data(), z[1]);
  store(z2.data(), z[2]);
  for (std::size_t i = 0; i < static_cast<std::size_t>(kLanes); ++i) {
    const double z0 = static_cast<double>(z0_[i]), a = static_cast<double>(areas[i]);
    z_edge1_[i] = static_cast<float>((static_cast<double>(z1[i]) - z0) / a);
    z_edge2_[i] = static_cast<float>((static_cast<double>(z2[i]) - z0) / a);
  }
}

Triangle TriangleBatch::triangle(int lane) const {
  const auto i = static_cast<std::size_t>(lane);
  const auto id = [&](std::size_t k) { return static_cast<uint32_t>(vertex_[k][i]); };
  return {.x = {x_[0][i], x_[1][i], x_[2][i]},
          .y = {y_[0][i], y_[1][i], y_[2][i]},
          .z0 = z0_[i],
          .z_edge1 = z_edge1_[i],
          .z_edge2 = z_edge2_[i],
          .z_max = z_max_[i],
          .vertex = {id(0), id(1), id(2)},
          .flags = static_cast<uint32_t>(flags_[i])};
}

}  // namespace halfspace
