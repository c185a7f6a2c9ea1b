// SPDX-License-Identifier: Apache-2.0
//
// What the shader kernels read of a triangle: its vertices, varyings and primitive values, of one triangle or of a different one in every
// lane.
#pragma once

#include "halfspace/raster/shade/fragment_batch.h"
#include "halfspace/shading/contract.h"

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
void find_triangle(const PassContext& context, TriangleId id, TriangleSource& out);

/// What the kernels read where each lane may show another triangle: which rows of the draw's varyings.
struct TriangleRows {
  const float* varyings;
  std::array<Int, 3> row;  ///< of the vertices, in the order of TriangleLanes
  Int provoking_row;
  std::array<const float*, kLanes> primitive;  ///< the primitive stage's rows
};
/// Gathers the triangles of `lanes` (not empty; all of one draw); other lanes repeat the first. False, and nothing is said, if
/// one of them is clipped, a point or a line, or the draw has too many vertices for gathers.
bool gather_rows(const PassContext& context, const TriangleId* ids, uint32_t lanes, TriangleLanes<Real>& triangles, Mask& front,
                 TriangleRows& rows);

/// Where Pixel::z() of a packet looks: the triangles of `lanes`.
struct PacketTriangleIds {
  const PassContext* context;
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
HS_INLINE TriangleScalars<kComponents<V>> scalars_of(const PassContext& context, TriangleId id) {
  TriangleSource source;
  find_triangle(context, id, source);
  return triangle_scalars<V>(source);
}

}  // namespace detail

}  // namespace halfspace
