// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/setup_simd.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "halfspace/core/transpose.h"
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/triangle_lanes.h"
#include "halfspace/raster/primitives/setup_scalar.h"
#include "halfspace/raster/primitives/tiny_coverage.h"

namespace halfspace::HS_LANES {

namespace {

// Prefetches the indices of a later batch. The address may be past the end of the list, but it is never dereferenced.
void prefetch_indices(const uint32_t* list) {
  constexpr std::size_t batch = 3 * kLanes * sizeof(uint32_t), line = 64;
  const auto ahead = reinterpret_cast<std::uintptr_t>(list) + 8 * batch;
  for (std::size_t i = 0; i < batch; i += line) __builtin_prefetch(reinterpret_cast<const void*>(ahead + i));
}

}  // namespace

bool TriangleBatch::serves(const Draw& draw) {
  const DrawState& s = draw.state;
  return kLanes > 1 && !draw.is_smooth && s.polygon_mode == PolygonMode::fill && draw.kernels.clip_distance_count == 0 &&
         draw.kernels.cull_distance_count == 0 && !has_offset(s.offset, s.polygon_mode);
}

void TriangleBatch::put_list(const uint32_t* indices, int count, uint32_t base) {
  prefetch_indices(indices);
  const auto* list = reinterpret_cast<const int32_t*>(indices);
  std::array<int32_t, 3 * kLanes> few;
  if (count < kLanes) {
    for (int i = 0; i < kLanes; ++i) std::copy_n(list + 3 * std::min(i, count - 1), 3, &few[static_cast<std::size_t>(3 * i)]);
    list = few.data();
  }
  const std::array<Int, 3> vertex = load_aos3<Int>(list);
  for (std::size_t i = 0; i < 3; ++i) store(vertex_[i].data(), vertex[i] - static_cast<int32_t>(base));
}

void TriangleBatch::put_sequence(uint32_t first, int count, uint32_t base) {
  const Int corner = min(iota<Int>(), Int(count - 1)) * 3 + static_cast<int32_t>(first - base);
  for (std::size_t i = 0; i < 3; ++i) store(vertex_[i].data(), corner + static_cast<int32_t>(i));
}

void TriangleBatch::set_up(const PassContext& context, const Draw& draw, const ShadedVertices& shaded, uint32_t lanes, uint32_t provoking,
                           uint32_t range, PassStatistics& statistics) {
  static_assert(sizeof(ScreenVertex) == 4 * sizeof(int32_t));
  std::array<Int, 3> v, x, y;
  std::array<Real, 3> z;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = load<Int>(vertex_[i].data());
    const std::array<Int, 4> vertex =
        load_aos4<Int>([&](int k) { return &shaded.screen[static_cast<uint32_t>(vertex_[i][static_cast<std::size_t>(k)])]; });
    x[i] = vertex[0];
    y[i] = vertex[1];
    z[i] = as_real(vertex[2]);
  }
  const uint32_t narrow = bits(max_of(x) - min_of(x) <= Int(kNarrowExtent) && max_of(y) - min_of(y) <= Int(kNarrowExtent));
  large_ = lanes & ~narrow;
  lanes &= narrow;
  // |area| is at most 2·kSmallExtent² < 2^29.
  const Int area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
  const Mask counter_clockwise = area > Int(0);
  const Mask clockwise = !counter_clockwise;
  const Mask front = is_front(draw.state, true) ? counter_clockwise : clockwise;
  const bool culls_front = is_culled(draw.state.cull, true), culls_back = is_culled(draw.state.cull, false);
  const PixelBox<Int> box = intersect(pixel_box(x, y, context.samples_at, context.samples_at), draw.bounds);
  const auto take = [&](uint32_t which, uint64_t& counter) {
    counter += static_cast<uint64_t>(std::popcount(lanes & which));
    lanes &= ~which;
  };
  take(bits(area == Int(0)), statistics.culled_degenerate);
  take(bits(select(front, Mask(culls_front), Mask(culls_back))), statistics.culled_face);
  take(bits(box.empty()), statistics.culled_no_sample);
  swap_lanes(clockwise, x[1], x[2]);
  swap_lanes(clockwise, y[1], y[2]);
  const Mask few = box.fits_in(kTinySide, kTinySide);
  Int covered(0);
  if (context.samples == 1 && (bits(few) & lanes) != 0) {
    covered = select(few, covered_centers<Real>(x, y, box), Int(0));
    take(bits(few && covered == Int(0)), statistics.culled_no_sample);
  }
  kept_ = lanes;
  if (lanes == 0) return;

  // Put the vertices in counter-clockwise order, starting with the smallest depth.
  std::array<Int, 3> order{Int(0), Int(1), Int(2)};
  swap_lanes(clockwise, z[1], z[2]);
  swap_lanes(clockwise, v[1], v[2]);
  swap_lanes(clockwise, order[1], order[2]);
  const Real z_min = min_of(z), z_max = max_of(z);
  const Mask one = (z[0] != z_min) & (z[1] == z_min), two = (z[0] != z_min) & (z[1] != z_min);
  rotate_lanes(one, two, x);
  rotate_lanes(one, two, y);
  rotate_lanes(one, two, z);
  rotate_lanes(one, two, v);
  rotate_lanes(one, two, order);
  x_ = x;
  y_ = y;
  ordered_vertex_ = v;
  z0_ = z[0];
  z_max_ = z_max;
  const Int wanted(static_cast<int32_t>(provoking));
  const Int place = select(order[0] == wanted, Int(0), select(order[1] == wanted, Int(1), Int(2)));
  flags_ = (place << static_cast<int>(kProvokingShift)) | Int(static_cast<int32_t>(kNarrow | range << kDrawRangeShift)) |
           select(front, Int(static_cast<int32_t>(kFrontFacing)), Int(0)) | covered_flags(box, covered);
  alignas(64) std::array<int32_t, kLanes> areas;
  alignas(64) std::array<float, kLanes> z0, z1, z2, z_edge1, z_edge2;
  store(areas.data(), max(area, -area));
  store(z0.data(), z[0]);
  store(z1.data(), z[1]);
  store(z2.data(), z[2]);
  for (std::size_t i = 0; i < static_cast<std::size_t>(kLanes); ++i) {
    const double from = static_cast<double>(z0[i]), a = static_cast<double>(areas[i]);
    z_edge1[i] = static_cast<float>((static_cast<double>(z1[i]) - from) / a);
    z_edge2[i] = static_cast<float>((static_cast<double>(z2[i]) - from) / a);
  }
  z_edge1_ = load<Real>(z_edge1.data());
  z_edge2_ = load<Real>(z_edge2.data());
}

void TriangleBatch::write(Triangle* out) const {
  Triangle spare;
  std::array<Triangle*, kLanes> to;
  for (std::size_t k = 0; k < to.size(); ++k) {
    const bool keeps = (kept_ >> k & 1) != 0;
    to[k] = keeps ? out : &spare;
    out += keeps ? 1 : 0;
  }
  const auto words_from = [&to](std::size_t first) {
    return [&to, first](int k) { return reinterpret_cast<int32_t*>(to[static_cast<std::size_t>(k)]) + first; };
  };
  static_assert(sizeof(Triangle) == 14 * sizeof(int32_t) && offsetof(Triangle, z0) == 6 * sizeof(int32_t) &&
                offsetof(Triangle, vertex) == 10 * sizeof(int32_t));
  const auto& v = ordered_vertex_;
  store_aos4<Int>({x_[0], x_[1], x_[2], y_[0]}, words_from(0));
  store_aos4<Int>({y_[1], y_[2], as_int(z0_), as_int(z_edge1_)}, words_from(4));
  store_aos4<Int>({as_int(z_edge2_), as_int(z_max_), v[0], v[1]}, words_from(8));
  store_aos4<Int>({v[0], v[1], v[2], flags_}, words_from(10));
}

}  // namespace halfspace::HS_LANES
