// SPDX-License-Identifier: Apache-2.0
//
// Triangle data for packets. The pixels of a packet can belong to one triangle, to several, or to a different one in each lane. The values
// of all triangles are merged or gathered into the lanes that show them, so that the shader runs only once.
#pragma once

#include <algorithm>
#include <bit>

#include "halfspace/core/lane_pairs.h"
#include "halfspace/core/transpose.h"
#include "halfspace/raster/shade/triangle_attributes.h"

namespace halfspace::HS_LANES {

namespace detail {

/// Returns the cell of a batch's pixels. They belong to one tile, and therefore to one cell.
HS_INLINE PlaneCell cell_of(const PacketBatch& batch) {
  const int32_t packed = batch.pixels != nullptr ? batch.pixels[0] : 0;
  const int packet = batch.packets[0].packet;
  const int x = batch.pixels != nullptr ? packed & 0xffff : packet_x(packet), y = batch.pixels != nullptr ? packed >> 16 : packet_y(packet);
  return PlaneCell::of(batch.tile_x0 + x, batch.tile_y0 + y);
}

/// Cache of recently used triangles. Adjacent packets usually show the same ones.
template <class V, bool with_id = false>
class RecentTriangles {
 public:
  using Scalars = TriangleScalars<kComponents<V>, with_id>;

  explicit RecentTriangles(const PlaneCell& cell) : cell_(cell) {}

  /// Returns the values of the first triangle. The cache must be empty.
  HS_INLINE const Scalars& first(const PassContext& context, TriangleId id) { return add(context, id); }

  /// Returns the values of a triangle. The result of the previous call remains valid.
  HS_INLINE const Scalars& of(const PassContext& context, TriangleId id) {
    uint32_t same = 0;
    for (std::size_t i = 0; i < kMaxCount; i += kLanes) same |= bits(load<Int>(&ids_[i]) == Int(std::bit_cast<int32_t>(id))) << i;
    same &= ~(1u << next_);  // this entry is replaced next, so it must not be returned
    return same != 0 ? scalars_[static_cast<std::size_t>(std::countr_zero(same))] : add(context, id);
  }

 private:
  static constexpr std::size_t kMaxCount = 16;
  static constexpr std::array<TriangleId, kMaxCount> kNone = [] {
    std::array<TriangleId, kMaxCount> none;
    none.fill(kNoTriangle);
    return none;
  }();

  __attribute__((noinline)) const Scalars& add(const PassContext& context, TriangleId id) {
    const std::size_t place = next_;
    next_ = (next_ + 1) % kMaxCount;
    ids_[place] = id;
    return scalars_[place] = scalars_of<V, with_id>(context, id, cell_);
  }

  PlaneCell cell_;
  std::array<TriangleId, kMaxCount> ids_ = kNone;
  std::array<Scalars, kMaxCount> scalars_;
  std::size_t next_ = 0;  ///< the entry that is replaced next
};

/// Triangle values for two packets, per lane. P: number of values per triangle from the primitive stage. with_id: for shaders that use a
/// PrimitiveId.
template <std::size_t N, std::size_t P, bool with_id = false>
struct PacketTriangles {
  std::array<TriangleId, 2> only{kNoTriangle, kNoTriangle};  ///< the triangle, if all lanes of a packet show the same one
  TriangleLanes<FragmentReal> lanes;
  ComponentLanes<FragmentReal, N> components;
  std::array<FragmentReal, P> primitive;
  MaskOf<FragmentReal> front;
  [[no_unique_address]] MemberIf<with_id, ComponentLanes<FragmentReal, 2>, 0> barycentrics;  ///< see TriangleScalars
};

/// Calls put(value, member) for each value of packet i. member reads the same value from another struct.
template <int i, class F>
HS_INLINE void for_each_corner_value(TriangleLanes<FragmentReal>& t, F put) {
  put(half<i>(t.x0), [](const auto& s) { return s.x0; });
  put(half<i>(t.y0), [](const auto& s) { return s.y0; });
  put(half<i>(t.e1x), [](const auto& s) { return s.e1x; });
  put(half<i>(t.e1y), [](const auto& s) { return s.e1y; });
  put(half<i>(t.e2x), [](const auto& s) { return s.e2x; });
  put(half<i>(t.e2y), [](const auto& s) { return s.e2y; });
  put(half<i>(t.area), [](const auto& s) { return s.area; });
  put(half<i>(t.q0), [](const auto& s) { return s.q0; });
  put(half<i>(t.q1), [](const auto& s) { return s.q1; });
  put(half<i>(t.q2), [](const auto& s) { return s.q2; });
  put(half<i>(t.q_unscale), [](const auto& s) { return s.q_unscale; });
}

/// The same for all values in a TriangleScalars.
template <int i, std::size_t N, std::size_t P, bool with_id, class F>
HS_INLINE void for_each_value(PacketTriangles<N, P, with_id>& t, F put) {
  using S = TriangleScalars<N, with_id>;
  for_each_corner_value<i>(t.lanes, put);
  for (std::size_t k = 0; k < N; ++k) {
    put(half<i>(t.components.value0[k]), [k](const S& s) { return s.value0[k]; });
    put(half<i>(t.components.delta1[k]), [k](const S& s) { return s.delta1[k]; });
    put(half<i>(t.components.delta2[k]), [k](const S& s) { return s.delta2[k]; });
  }
  for (std::size_t k = 0; k < P; ++k) put(half<i>(t.primitive[k]), [k](const S& s) { return s.primitive[k]; });
  if constexpr (with_id) {
    for (std::size_t k = 0; k < 2; ++k) {
      put(half<i>(t.barycentrics.value0[k]), [k](const S& s) { return s.barycentrics.value0[k]; });
      put(half<i>(t.barycentrics.delta1[k]), [k](const S& s) { return s.barycentrics.delta1[k]; });
      put(half<i>(t.barycentrics.delta2[k]), [k](const S& s) { return s.barycentrics.delta2[k]; });
    }
  }
}

/// Copies the values of one triangle to all lanes of packet i.
template <int i, std::size_t N, std::size_t P, bool with_id>
HS_INLINE void spread_triangle(const TriangleScalars<N, with_id>& s, PacketTriangles<N, P, with_id>& out) {
  for_each_value<i>(out, [&](Real& lanes, auto value) { lanes = spread<Real>(value(s)); });
  half<i>(out.front) = Mask(s.front);
  half<i>(out.lanes.planar) = Mask(s.planar);
}

/// Merges the values of two triangles into packet i. Lanes that show the second triangle get its values. All other lanes get the values of
/// the first, so that lanes without a triangle compute with finite values.
template <int i, std::size_t N, std::size_t P, bool with_id>
HS_INLINE void merge_two(const TriangleScalars<N, with_id>& first, const TriangleScalars<N, with_id>& second, Mask shows_second,
                         PacketTriangles<N, P, with_id>& out) {
  for_each_value<i>(
      out, [&](Real& lanes, auto value) { lanes = select(shows_second, spread<Real>(value(second)), spread<Real>(value(first))); });
  half<i>(out.front) = select(shows_second, Mask(second.front), Mask(first.front));
  half<i>(out.lanes.planar) = select(shows_second, Mask(second.planar), Mask(first.planar));
}

/// Copies the values of another triangle to the lanes of packet i that show it.
template <int i, std::size_t N, std::size_t P, bool with_id>
HS_INLINE void add_triangle(const TriangleScalars<N, with_id>& s, Mask shows, PacketTriangles<N, P, with_id>& out) {
  for_each_value<i>(out, [&](Real& lanes, auto value) { lanes = select(shows, spread<Real>(value(s)), lanes); });
  Mask &front = half<i>(out.front), &planar = half<i>(out.lanes.planar);
  front = select(shows, Mask(s.front), front);
  planar = select(shows, Mask(s.planar), planar);
}

/// Loads up to four consecutive components of the rows at `at`, starting with component k: the flat ones or all others. The remaining
/// elements are unspecified.
template <class V, std::size_t k, bool flat>
HS_INLINE std::array<Real, 4> row_components(const float* varyings, Int at) {
  constexpr std::size_t count = std::min<std::size_t>(4, kComponents<V> - k);
  constexpr auto is_wanted = [](std::size_t c) { return (kInterpolations<V>[k + c] == Interpolation::flat) == flat; };
  constexpr std::size_t wanted = [is_wanted] {
    std::size_t n = 0;
    for (std::size_t c = 0; c < count; ++c) n += is_wanted(c) ? 1 : 0;
    return n;
  }();
  std::array<Real, 4> row{};
  if constexpr (wanted > 1) {
    std::ranges::copy(gather_row<static_cast<int>(count)>(varyings + k, at), row.begin());
  } else {
    for (std::size_t c = 0; c < count; ++c) {
      if (is_wanted(c)) row[c] = gather(varyings + k + c, at);
    }
  }
  return row;
}

/// Gathers the components of the rows into packet i.
template <int i, class V, std::size_t N, std::size_t P, bool with_id>
HS_INLINE void gather_components(const TriangleRows& rows, PacketTriangles<N, P, with_id>& out) {
  const auto gather_four = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) {
    const auto smooth = [&](Int row) { return row_components<V, k, false>(rows.varyings, row * static_cast<int32_t>(N)); };
    const auto v0 = smooth(rows.row[0]), v1 = smooth(rows.row[1]), v2 = smooth(rows.row[2]);
    const auto flat_values = row_components<V, k, true>(rows.varyings, rows.provoking_row * static_cast<int32_t>(N));
    for (std::size_t c = 0; c < std::min<std::size_t>(4, N - k); ++c) {
      const bool flat = kInterpolations<V>[k + c] == Interpolation::flat;
      half<i>(out.components.value0[k + c]) = flat ? flat_values[c] : v0[c];
      half<i>(out.components.delta1[k + c]) = flat ? Real(0.0f) : v1[c] - v0[c];
      half<i>(out.components.delta2[k + c]) = flat ? Real(0.0f) : v2[c] - v0[c];
    }
  };
  const auto gather_all = [&]<std::size_t... n>(std::index_sequence<n...>) {
    (gather_four(std::integral_constant<std::size_t, 4 * n>{}), ...);
  };
  gather_all(std::make_index_sequence<(N + 3) / 4>());
  for (std::size_t k = 0; k < P; ++k) {
    for (int lane = 0; lane < kLanes; ++lane) set_lane(half<i>(out.primitive[k]), lane, rows.primitive[static_cast<std::size_t>(lane)][k]);
  }
  if constexpr (with_id) {
    for (std::size_t k = 0; k < 2; ++k) {
      const Int slot = as_int(half<i>(out.primitive[kIdSecond + k]));
      const auto weight = [&](std::size_t vertex) { return select(rows.row[vertex] == slot, Real(1.0f), Real(0.0f)); };
      half<i>(out.barycentrics.value0[k]) = weight(0);
      half<i>(out.barycentrics.delta1[k]) = weight(1) - weight(0);
      half<i>(out.barycentrics.delta2[k]) = weight(2) - weight(0);
    }
  }
}

/// Returns the first lane of each distinct triangle in `lanes`, as a bit mask. If there are more than max_triangles, some may be missing.
template <class I>
HS_INLINE uint32_t first_lane_of_each(I packet_ids, const TriangleId* ids, uint32_t lanes, int max_triangles) {
#ifdef __AVX512CD__
  if constexpr (std::is_same_v<I, IntN<16>>) {
    const __m512i equal_before = _mm512_maskz_conflict_epi32(kAll16, (__m512i)packet_ids.v);
    return lanes & _mm512_testn_epi32_mask(equal_before, _mm512_set1_epi32(static_cast<int32_t>(lanes)));
  }
#endif
  uint32_t firsts = 0;
  for (uint32_t rest = lanes; rest != 0 && max_triangles > 0; --max_triangles) {
    const int lane = std::countr_zero(rest);
    firsts |= 1u << lane;
    rest &= ~bits(packet_ids == I(std::bit_cast<int32_t>(ids[lane])));
  }
  return firsts;
}

/// Minimum number of triangles in a packet for which values are gathered instead of merged.
inline constexpr int kGatherFrom = 3;

/// Merges the triangles of packet i one by one. Used where gather_rows() fails. firsts: one lane of each triangle.
template <int i, class V, std::size_t N, std::size_t P, bool with_id>
__attribute__((noinline)) void merge_many(const PassContext& context, const TriangleId* ids, uint32_t firsts,
                                          RecentTriangles<V, with_id>& recent, PacketTriangles<N, P, with_id>& t) {
  const Int packet_ids = load<Int>(ids);
  spread_triangle<i>(recent.of(context, ids[std::countr_zero(firsts)]), t);
  for (uint32_t rest = firsts & (firsts - 1); rest != 0; rest &= rest - 1) {
    const TriangleId id = ids[std::countr_zero(rest)];
    add_triangle<i>(recent.of(context, id), packet_ids == Int(std::bit_cast<int32_t>(id)), t);
  }
}

/// Stores the values of one triangle as packet i of t, unless t already contains it, as recorded in t.only[i].
template <int i, class V, std::size_t N, std::size_t P, bool with_id>
HS_INLINE void show_triangle(const PassContext& context, TriangleId id, RecentTriangles<V, with_id>& recent,
                             PacketTriangles<N, P, with_id>& t) {
  if (t.only[i] != id) spread_triangle<i>(recent.of(context, id), t);
  t.only[i] = id;
}

/// Finds the triangles of packet n of the batch and stores their values as packet i of t.
template <int i, class V, std::size_t N, std::size_t P, bool with_id>
HS_INLINE void find_triangles(const PacketBatch& batch, int n, RecentTriangles<V, with_id>& recent, PacketTriangles<N, P, with_id>& t) {
  TriangleId& only = t.only[i];
  const PassContext& context = *batch.context;
  if (batch.ids == nullptr) return show_triangle<i>(context, batch.packet_ids[n], recent, t);
  const PacketMask packet = batch.packets[n];
  const TriangleId* ids = batch.ids + static_cast<std::size_t>(packet.packet) * kLanes;
  const Int packet_ids = load<Int>(ids);
  const uint32_t firsts = first_lane_of_each(packet_ids, ids, packet.lanes, kGatherFrom);
  const TriangleId first = ids[std::countr_zero(firsts)];
  const int triangles = std::popcount(firsts);
  if (triangles == 1 && only == first) return;
  only = triangles == 1 ? first : kNoTriangle;
  if (triangles < kGatherFrom) {
    const TriangleScalars<N, with_id>& a = recent.of(context, first);
    if (triangles == 1) return spread_triangle<i>(a, t);
    const TriangleId second = ids[std::countr_zero(firsts & (firsts - 1))];
    return merge_two<i>(a, recent.of(context, second), packet_ids == Int(std::bit_cast<int32_t>(second)), t);
  }
  TriangleRows rows;
  TriangleLanes<Real> lanes;
  if (gather_rows(context, ids, packet.lanes, lanes, half<i>(t.front), rows)) {
    for_each_corner_value<i>(t.lanes, [&](Real& to, auto value) { to = value(lanes); });
    half<i>(t.lanes.planar) = lanes.planar;
    return gather_components<i, V>(rows, t);
  }
  merge_many<i>(context, ids, first_lane_of_each(packet_ids, ids, packet.lanes, kLanes), recent, t);
}

}  // namespace detail

}  // namespace halfspace::HS_LANES
