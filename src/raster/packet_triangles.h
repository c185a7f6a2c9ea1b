// SPDX-License-Identifier: Apache-2.0
//
// The triangles of packets. A packet may show one triangle, a few, or a different one in every lane: the values of each are merged into the
// lanes that show it, or gathered, so that a shader runs once.
#pragma once

#include <bit>

#include "core/lane_pairs.h"
#include "raster/shade.h"
#include "shading/contract.h"

namespace halfspace {

/// What the kernels read of one triangle, wherever it is kept.
struct TriangleSource {
  const Triangle* triangle;
  std::array<const ScreenVertex*, 3> vertex;
  std::array<ScreenVertex, 3> corners;  ///< what vertex points to, of points and lines
  std::array<const float*, 3> varyings;
  const float* flat_varyings;  ///< the provoking vertex's row
  const float* primitive;      ///< the primitive stage's row, or null
  float z_low;                 ///< the least depth in the window
};
void find_triangle(const Frame& frame, TriangleId id, TriangleSource& out);

/// What the kernels read where each lane may show another triangle: which rows of the draw's varyings.
struct TriangleRows {
  const float* varyings;
  std::array<Int, 3> row;  ///< of the vertices, in the order of TriangleLanes
  Int provoking_row;
  std::array<const float*, kLanes> primitive;  ///< the primitive stage's rows
};
/// Gathers the triangles of `lanes` (not empty; all of one draw); other lanes repeat the first. False, and nothing is said, if
/// one of them is clipped, a point or a line, or the draw has too many vertices for gathers.
bool gather_rows(const Frame& frame, const TriangleId* ids, uint32_t lanes, TriangleLanes<Real>& triangles, Mask& front,
                 TriangleRows& rows);

/// Where Pixel::z() of a packet looks: the triangles of `lanes`.
struct PacketTriangleIds {
  const Frame* frame;
  const TriangleId* ids;  ///< or null: uniform_id everywhere
  TriangleId uniform_id;
  uint32_t lanes;
};
/// The window depth of a packet's pixels, at x and y px in the window, within an ulp of what the visibility stage tested.
Real packet_depth(Real x, Real y, const PacketTriangleIds& ids);

namespace detail {

/// 1/w of three vertices over a power of two near the largest: products with areas up to 2^47 then neither overflow nor underflow.
template <class R>
struct ScaledInverseW {
  R q0, q1, q2, unscale;
};
template <class R>
HS_INLINE ScaledInverseW<R> scaled(R q0, R q1, R q2) {
  const IntOf<R> exponent = as_int(max(q0, max(q1, q2))) & 0x7f800000;
  const R scale = as_real(IntOf<R>(0x7f000000) - exponent);  // 2^(127 − e) for the largest in [2^(e−127), 2^(e−126))
  return {q0 * scale, q1 * scale, q2 * scale, as_real(exponent)};
}

/// What interpolation needs of one triangle, before it is spread to lanes. Vertex 0 is the one with the smallest 1/w.
template <std::size_t N>
struct TriangleScalars {
  float x0, y0, e1x, e1y, e2x, e2y, area, q0, q1, q2, q_unscale;
  std::array<float, N> value0, delta1, delta2;
  const float* primitive;  ///< the primitive stage's row, or null
  bool front;
};

/// V is the Varyings struct with R = float, which tells how each component is interpolated.
template <class V, std::size_t N = kComponents<V>>
HS_INLINE TriangleScalars<N> triangle_scalars(const TriangleSource& s) {
  std::size_t a = 0;
  if (s.vertex[1]->inv_w < s.vertex[a]->inv_w) a = 1;
  if (s.vertex[2]->inv_w < s.vertex[a]->inv_w) a = 2;
  const std::size_t b = a == 2 ? 0 : a + 1;
  const std::size_t c = b == 2 ? 0 : b + 1;
  const ScreenVertex &v0 = *s.vertex[a], &v1 = *s.vertex[b], &v2 = *s.vertex[c];
  TriangleScalars<N> r;
  r.x0 = static_cast<float>(v0.x);
  r.y0 = static_cast<float>(v0.y);
  r.e1x = static_cast<float>(v1.x - v0.x);
  r.e1y = static_cast<float>(v1.y - v0.y);
  r.e2x = static_cast<float>(v2.x - v0.x);
  r.e2y = static_cast<float>(v2.y - v0.y);
  r.area = difference_of_products(r.e1x, r.e2y, r.e1y, r.e2x);
  const ScaledInverseW<float> q = scaled(v0.inv_w, v1.inv_w, v2.inv_w);
  r.q_unscale = q.unscale;
  r.q0 = q.q0;
  r.q1 = q.q1;
  r.q2 = q.q2;
  for (std::size_t i = 0; i < N; ++i) {
    const bool flat = kInterpolations<V>[i] == Interpolation::flat;
    r.value0[i] = flat ? s.flat_varyings[i] : s.varyings[a][i];
    r.delta1[i] = flat ? 0.0f : s.varyings[b][i] - s.varyings[a][i];
    r.delta2[i] = flat ? 0.0f : s.varyings[c][i] - s.varyings[a][i];
  }
  r.primitive = s.primitive;
  r.front = s.triangle->is(kFrontFacing);
  return r;
}

template <class V>
HS_INLINE TriangleScalars<kComponents<V>> scalars_of(const Frame& frame, TriangleId id) {
  TriangleSource source;
  find_triangle(frame, id, source);
  return triangle_scalars<V>(source);
}

/// The scalars of the triangles that were asked for last: neighbouring packets show the same ones.
template <class V>
class RecentTriangles {
 public:
  HS_INLINE const TriangleScalars<kComponents<V>>& of(const Frame& frame, TriangleId id) {
    uint32_t same = 0;
    for (std::size_t i = 0; i < kMost; i += kLanes) same |= bits(load<Int>(&ids_[i]) == Int(std::bit_cast<int32_t>(id))) << i;
    if (same != 0) return scalars_[static_cast<std::size_t>(std::countr_zero(same))];
    newest_ = (newest_ + 1) % kMost;
    ids_[newest_] = id;
    return scalars_[newest_] = scalars_of<V>(frame, id);
  }

 private:
  static constexpr std::size_t kMost = 16;
  static constexpr std::array<TriangleId, kMost> kNone = [] {
    std::array<TriangleId, kMost> none;
    none.fill(kNoTriangle);
    return none;
  }();
  std::array<TriangleId, kMost> ids_ = kNone;
  std::array<TriangleScalars<kComponents<V>>, kMost> scalars_;
  std::size_t newest_ = kMost - 1;
};

/// Everything two packets need of their triangles, lane by lane. P: components of the primitive stage's struct.
template <std::size_t N, std::size_t P>
struct PacketTriangles {
  std::array<TriangleId, 2> only{kNoTriangle, kNoTriangle};  ///< where all lanes of a packet show one triangle, that
  TriangleLanes<FragmentReal> lanes;
  ComponentLanes<FragmentReal, N> components;
  std::array<FragmentReal, P> primitive;
  MaskOf<FragmentReal> front;
};

/// Spreads one triangle's values to packet i of the two: the packet's first to all lanes, so that lanes without a triangle compute with
/// finite values; the others to the lanes of m.
template <int i, bool first, std::size_t N, std::size_t P>
HS_INLINE void merge_triangle(const TriangleScalars<N>& s, Mask m, PacketTriangles<N, P>& out) {
  const auto put = [=](FragmentReal& lanes, float value) {
    Real& to = half<i>(lanes);
    if constexpr (first) {
      to = Real(value);
    } else {
      to = select(m, Real(value), to);
    }
  };
  TriangleLanes<FragmentReal>& t = out.lanes;
  put(t.x0, s.x0);
  put(t.y0, s.y0);
  put(t.e1x, s.e1x);
  put(t.e1y, s.e1y);
  put(t.e2x, s.e2x);
  put(t.e2y, s.e2y);
  put(t.area, s.area);
  put(t.q0, s.q0);
  put(t.q1, s.q1);
  put(t.q2, s.q2);
  put(t.q_unscale, s.q_unscale);
  for (std::size_t k = 0; k < N; ++k) {
    put(out.components.value0[k], s.value0[k]);
    put(out.components.delta1[k], s.delta1[k]);
    put(out.components.delta2[k], s.delta2[k]);
  }
  for (std::size_t k = 0; k < P; ++k) put(out.primitive[k], s.primitive[k]);
  Mask& front = half<i>(out.front);
  front = first ? Mask(s.front) : select(m, Mask(s.front), front);
}

/// The components of rows, gathered into packet i.
template <int i, class V, std::size_t N, std::size_t P>
HS_INLINE void gather_components(const TriangleRows& rows, PacketTriangles<N, P>& out) {
  constexpr auto n = static_cast<int32_t>(N);
  const std::array<Int, 4> at{rows.row[0] * n, rows.row[1] * n, rows.row[2] * n, rows.provoking_row * n};
  for (std::size_t k = 0; k < N; ++k) {
    const float* column = rows.varyings + k;
    const bool flat = kInterpolations<V>[k] == Interpolation::flat;
    const Real value0 = gather(column, flat ? at[3] : at[0]);
    half<i>(out.components.value0[k]) = value0;
    half<i>(out.components.delta1[k]) = flat ? Real(0.0f) : gather(column, at[1]) - value0;
    half<i>(out.components.delta2[k]) = flat ? Real(0.0f) : gather(column, at[2]) - value0;
  }
  for (std::size_t k = 0; k < P; ++k) {
    for (int lane = 0; lane < kLanes; ++lane) set_lane(half<i>(out.primitive[k]), lane, rows.primitive[static_cast<std::size_t>(lane)][k]);
  }
}

/// The lanes of packet i.
template <int i>
HS_INLINE void put_triangles(const TriangleLanes<Real>& from, TriangleLanes<FragmentReal>& to) {
  half<i>(to.x0) = from.x0;
  half<i>(to.y0) = from.y0;
  half<i>(to.e1x) = from.e1x;
  half<i>(to.e1y) = from.e1y;
  half<i>(to.e2x) = from.e2x;
  half<i>(to.e2y) = from.e2y;
  half<i>(to.area) = from.area;
  half<i>(to.q0) = from.q0;
  half<i>(to.q1) = from.q1;
  half<i>(to.q2) = from.q2;
  half<i>(to.q_unscale) = from.q_unscale;
}

/// Triangles of a packet from which on they are gathered, not merged one by one.
inline constexpr int kGatherFrom = 4;

/// Of the lanes (a bit each) those whose triangle no lower one shows; beyond `most` of them any may be left out.
template <class I>
HS_INLINE uint32_t first_lanes(I packet_ids, const TriangleId* ids, uint32_t lanes, int most) {
#ifdef __AVX512CD__
  if constexpr (std::is_same_v<I, IntN<16>>) {
    const __m512i equal_before = _mm512_maskz_conflict_epi32(kAll16, (__m512i)packet_ids.v);
    return lanes & _mm512_testn_epi32_mask(equal_before, _mm512_set1_epi32(static_cast<int32_t>(lanes)));
  }
#endif
  uint32_t firsts = 0;
  for (uint32_t rest = lanes; rest != 0 && most > 0; --most) {
    const int lane = std::countr_zero(rest);
    firsts |= 1u << lane;
    rest &= ~bits(packet_ids == I(std::bit_cast<int32_t>(ids[lane])));
  }
  return firsts;
}

/// The triangles of a packet, the i-th of t: one, few or many. t.only[i] is the one that t holds already, if it holds one alone.
template <int i, class V, std::size_t N, std::size_t P>
HS_INLINE void find_triangles(const FragmentBatch& batch, PacketMask packet, RecentTriangles<V>& recent, PacketTriangles<N, P>& t) {
  TriangleId& only = t.only[i];
  if (batch.ids == nullptr) {
    if (only != batch.uniform_id) merge_triangle<i, true>(recent.of(*batch.frame, batch.uniform_id), Mask(true), t);
    only = batch.uniform_id;
    return;
  }
  const TriangleId* ids = batch.ids + static_cast<std::size_t>(packet.packet) * kLanes;
  const Int packet_ids = load<Int>(ids);
  uint32_t firsts = first_lanes(packet_ids, ids, packet.lanes, kGatherFrom);
  const TriangleId first = ids[std::countr_zero(firsts)];
  const int triangles = std::popcount(firsts);
  if (triangles == 1 && only == first) return;
  only = triangles == 1 ? first : kNoTriangle;
  if (triangles >= kGatherFrom) {
    TriangleRows rows;
    TriangleLanes<Real> lanes;
    if (gather_rows(*batch.frame, ids, packet.lanes, lanes, half<i>(t.front), rows)) {
      put_triangles<i>(lanes, t.lanes);
      return gather_components<i, V>(rows, t);
    }
    firsts = first_lanes(packet_ids, ids, packet.lanes, kLanes);
  }
  merge_triangle<i, true>(recent.of(*batch.frame, first), Mask(true), t);
  for (uint32_t rest = firsts & (firsts - 1); rest != 0; rest &= rest - 1) {
    const TriangleId id = ids[std::countr_zero(rest)];
    merge_triangle<i, false>(recent.of(*batch.frame, id), packet_ids == Int(std::bit_cast<int32_t>(id)), t);
  }
}

}  // namespace detail

}  // namespace halfspace
