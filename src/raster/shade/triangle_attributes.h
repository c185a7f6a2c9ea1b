// SPDX-License-Identifier: Apache-2.0
//
// Triangle data for the shader kernels (vertices, varyings, primitive values), for one triangle or for a different one in each lane.
#pragma once

#include <bit>

#include "halfspace/raster/shade/fragment_batch.h"
#include "halfspace/raster/shade/plane_anchor.h"
#include "halfspace/shading/contract.h"

namespace halfspace::HS_LANES {

/// Data of one triangle, independent of how it is stored.
struct TriangleSource {
  const Triangle* triangle;
  std::array<const ScreenVertex*, 3> vertex;
  std::array<ScreenVertex, 3> corners;  ///< for points and lines: `vertex` points to these
  std::array<const float*, 3> varyings;
  const float* flat_varyings;  ///< row of the provoking vertex
  const float* primitive;      ///< row of the primitive stage, or null
};
/// Returns false if a triangle is certainly not given as planes.
HS_INLINE bool may_have_planes(const TriangleSource& s) {
  return s.triangle->is_wide_triangle() && s.vertex[0]->inv_w == s.vertex[1]->inv_w && s.vertex[0]->inv_w == s.vertex[2]->inv_w;
}
/// Returns the anchor of a triangle's planes for the pixels of a cell.
PlaneAnchor plane_anchor_of(const TriangleSource& source, const PlaneCell& cell);
/// Finds the data of a triangle.
void find_triangle(const PassContext& context, TriangleId id, TriangleSource& out);

/// Varyings of a different triangle in each lane, as rows of the draw's varyings.
struct TriangleRows {
  const float* varyings;
  std::array<Int, 3> row;  ///< rows of the vertices, in the order of TriangleLanes
  Int provoking_row;
  std::array<const float*, kLanes> primitive;  ///< rows of the primitive stage
};
/// Gathers the triangles of `lanes`. lanes must not be empty, and all triangles must belong to the same draw. Other lanes repeat the first
/// triangle. Returns false if a primitive is clipped or may be given as planes, or if the draw has too many vertices; outputs are then
/// unspecified.
bool gather_rows(const PassContext& context, const TriangleId* ids, uint32_t lanes, TriangleLanes<Real>& triangles, Mask& front,
                 TriangleRows& rows);

/// Triangles of a packet's lanes, for Pixel::z().
struct PacketTriangleIds {
  const PassContext* context;
  const TriangleId* ids;  ///< null if all lanes show uniform_id
  TriangleId uniform_id;
  uint32_t lanes;
};
/// Returns the depth of a packet's pixels. x and y are window coordinates in pixels. The depth differs from the value used in the depth
/// test by at most one ulp. The attribute allows the compiler to drop calls whose result a shader does not use.
__attribute__((pure)) Real packet_depth(Real x, Real y, const PacketTriangleIds& ids) noexcept;
/// Returns the samples of a packet's pixels that its triangles cover and whose draw may draw; see Pixel::sample_mask().
__attribute__((pure)) Int packet_sample_mask(Real x, Real y, const PacketTriangleIds& ids) noexcept;

namespace detail {

/// 1/w of three vertices, divided by a power of two close to the largest value. This prevents overflow and underflow in products with areas
/// of up to 2^47.
template <class R>
struct ScaledInverseW {
  R q0, q1, q2, unscale;
};
template <class R>
HS_INLINE ScaledInverseW<R> scaled(R q0, R q1, R q2) {
  const IntOf<R> exponent = as_int(max(q0, max(q1, q2))) & 0x7f800000;
  const R scale = as_real(IntOf<R>(0x7f000000) - exponent);  // 2^(127 − e) if the largest is in [2^(e−127), 2^(e−126))
  return {q0 * scale, q1 * scale, q2 * scale, as_real(exponent)};
}

/// Interpolation data of one triangle, before it is copied to lanes. Vertex 0 is the one with the smallest 1/w. with_id: for shaders that
/// use a PrimitiveId.
template <std::size_t N, bool with_id = false>
struct TriangleScalars {
  float x0, y0, e1x, e1y, e2x, e2y, area, q0, q1, q2, q_unscale;
  std::array<float, N> value0, delta1, delta2;
  const float* primitive;  ///< row of the primitive stage, or null
  bool front;
  bool planar;                                                                        ///< see TriangleLanes
  [[no_unique_address]] MemberIf<with_id, ComponentLanes<float, 2>, 0> barycentrics;  ///< weights of the submitted vertices 1 and 2
};

/// Returns the weights of the submitted vertices 1 and 2 at vertex i of the triangle. varyings: number of varyings of a vertex.
HS_INLINE std::array<float, 2> submitted_weights(const TriangleSource& s, std::size_t i, std::size_t varyings) {
  if (s.triangle->is(kClipped)) return {s.varyings[i][varyings], s.varyings[i][varyings + 1]};
  if (s.triangle->is_line() && i == 2) i = 0;  // this vertex has the values of the first
  const auto is_at = [&](IdRow slot) { return std::bit_cast<uint32_t>(s.primitive[slot]) == s.triangle->vertex[i] ? 1.0f : 0.0f; };
  return {is_at(kIdSecond), is_at(kIdThird)};
}

/// Computes the interpolation data of a triangle. V is the Varyings struct with R = float; it determines how components are interpolated.
template <class V, bool with_id = false, std::size_t N = kComponents<V>>
HS_INLINE TriangleScalars<N, with_id> triangle_scalars(const TriangleSource& s) {
  // Setup starts triangles with the smallest depth, so that all terms of the depth plane are nonnegative and depth is bounded by it.
  // Interpolation starts with the smallest 1/w, for accuracy. The two vertices can differ; one start for both would change bits.
  std::size_t a = 0;
  if (s.vertex[1]->inv_w < s.vertex[a]->inv_w) a = 1;
  if (s.vertex[2]->inv_w < s.vertex[a]->inv_w) a = 2;
  const std::size_t b = a == 2 ? 0 : a + 1;
  const std::size_t c = b == 2 ? 0 : b + 1;
  const ScreenVertex &v0 = *s.vertex[a], &v1 = *s.vertex[b], &v2 = *s.vertex[c];
  TriangleScalars<N, with_id> r;
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
  r.planar = false;
  if constexpr (with_id) {
    const std::array<float, 2> at0 = submitted_weights(s, a, N), at1 = submitted_weights(s, b, N), at2 = submitted_weights(s, c, N);
    for (std::size_t k = 0; k < 2; ++k) {
      r.barycentrics.value0[k] = at0[k];
      r.barycentrics.delta1[k] = at1[k] - at0[k];
      r.barycentrics.delta2[k] = at2[k] - at0[k];
    }
  }
  return r;
}

/// Replaces the interpolation data with planes. Triangles with the same 1/w at all vertices keep the order of their vertices.
template <class V, bool with_id, std::size_t N>
void use_planes(const TriangleSource& s, const PlaneAnchor& anchor, TriangleScalars<N, with_id>& r) {
  r.planar = true;
  r.x0 = static_cast<float>(anchor.x);
  r.y0 = static_cast<float>(anchor.y);
  r.e1x = r.e1y = r.e2x = r.e2y = 0.0f;
  r.area = 1.0f;
  const auto set = [&](float& value, float& slope_x, float& slope_y, float a0, float a1, float a2) {
    const std::array<float, 3> plane = anchor.plane(a0, a1, a2);
    value = plane[0];
    slope_x = plane[1];
    slope_y = plane[2];
  };
  for (std::size_t i = 0; i < N; ++i) {
    if (kInterpolations<V>[i] == Interpolation::flat) continue;
    set(r.value0[i], r.delta1[i], r.delta2[i], s.varyings[0][i], s.varyings[1][i], s.varyings[2][i]);
  }
  if constexpr (with_id) {
    const std::array<float, 2> at0 = submitted_weights(s, 0, N), at1 = submitted_weights(s, 1, N), at2 = submitted_weights(s, 2, N);
    for (std::size_t k = 0; k < 2; ++k)
      set(r.barycentrics.value0[k], r.barycentrics.delta1[k], r.barycentrics.delta2[k], at0[k], at1[k], at2[k]);
  }
}

/// The same for the pixels of a cell, where the triangle may be given as planes.
template <class V, bool with_id = false>
HS_INLINE TriangleScalars<kComponents<V>, with_id> scalars_in_cell(const TriangleSource& s, const PlaneCell& cell) {
  TriangleScalars<kComponents<V>, with_id> scalars = triangle_scalars<V, with_id>(s);
  if (may_have_planes(s)) {
    const PlaneAnchor anchor = plane_anchor_of(s, cell);
    if (anchor.is_valid) use_planes<V>(s, anchor, scalars);
  }
  return scalars;
}

/// The same for a triangle id.
template <class V, bool with_id = false>
HS_INLINE TriangleScalars<kComponents<V>, with_id> scalars_of(const PassContext& context, TriangleId id, const PlaneCell& cell) {
  TriangleSource source;
  find_triangle(context, id, source);
  return scalars_in_cell<V, with_id>(source, cell);
}

}  // namespace detail

}  // namespace halfspace::HS_LANES
