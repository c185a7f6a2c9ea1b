// SPDX-License-Identifier: Apache-2.0
//
// Interpolation, and what a fragment shader is told of its pixel.
//
// In: for each lane a triangle (snapped positions, 1/w, component values) and a pixel centre. Out: perspective-correct
// weights, component values there, their exact derivatives, and values at other pixels of the 2x2 quad.
//
// Let d = p − v0, e1 = v1 − v0, e2 = v2 − v0 in units of 1/256 px (whole numbers, exact in a float), and
//   E0 = (e1 − d) × (e2 − d),  E1 = d × e2,  E2 = e1 × d,  A = e1 × e2 = E0 + E1 + E2,
// so that E0/A, E1/A and E2/A are the barycentric weights. With q = 1/w the perspective weights (OpenGL 4.6, section
// 14.6.1, equation 14.9) are
//   pi = Ei·qi / D,  D = E0·q0 + E1·q1 + E2·q2.
// Inside of the triangle every term of D is non-negative, and the 2x2 determinants come from difference_of_products, so
// nothing cancels at any shape of triangle and any ratio of w. A value is a = a0 + p1·(a1 − a0) + p2·(a2 − a0), which
// keeps constants exact but counts an error of the weights up to twice: `normalized` takes out of the weights what
// division and sum have put in. Then a errs by less than 3e-7 of the largest |ai|.
#pragma once

#include <array>
#include <type_traits>

#include "halfspace/shading/varyings.h"

namespace halfspace {

/// The triangle of each lane, ready to interpolate. Positions are 24.8 fixed point window coordinates.
template <class R>
struct TriangleLanes {
  R x0, y0;              ///< v0 in 1/256 px: a whole number, |x| ≤ 2^22, as the lanes' float
  R e1x, e1y, e2x, e2y;  ///< edge vectors from v0 in 1/256 px
  R area;                ///< A > 0, in (1/256 px)²
  R q0, q1, q2;          ///< 1/w of the vertices times q_scale: the largest lies in [1, 2)
  R q_unscale;           ///< 1/q_scale, a power of two
};

/// Weights of a point in its lane's triangle.
template <class R>
struct Weights {
  R p1, p2;       ///< perspective-correct weights of v1, v2
  R b1, b2;       ///< window-space (linear) weights of v1, v2; where no varying is linear, p1 and p2
  R denominator;  ///< D above: 1/w at the point is D / A, rescaled
  R inverse;      ///< 1 / D
};

/// n1 and n2 over the sum of all three. The quotients are rounded, and so is the sum; what they lack of adding up to 1
/// is then shared out. 1 − larger is exact where it matters: from 1/2 on.
template <class R>
struct Normalized {
  R p1, p2, sum, inverse;
};
template <class R>
HS_INLINE Normalized<R> normalized(R n0, R n1, R n2) {
  const R sum = n0 + (n1 + n2);
  const R inverse = R(1) / sum;
  const R p1 = n1 * inverse, p2 = n2 * inverse;
  const R rest = fma(-n0, inverse, (R(1) - max(p1, p2)) - min(p1, p2));
  return {fma(p1, rest, p1), fma(p2, rest, p2), sum, inverse};
}

/// linear: the window-space weights are needed too.
template <bool linear = true, class R>
HS_INLINE Weights<R> weights_at(const TriangleLanes<R>& t, R dx, R dy) {
  const R e0 = difference_of_products(t.e1x - dx, t.e2y - dy, t.e1y - dy, t.e2x - dx);
  const R e1 = difference_of_products(dx, t.e2y, dy, t.e2x);
  const R e2 = difference_of_products(t.e1x, dy, t.e1y, dx);
  const Normalized<R> p = normalized(e0 * t.q0, e1 * t.q1, e2 * t.q2);
  const Normalized<R> b = linear ? normalized(e0, e1, e2) : p;
  return {p.p1, p.p2, b.p1, b.p2, p.sum, p.inverse};
}

/// One component at a point with weights w: value0 at v0, and its differences to v1 and v2.
template <Interpolation mode, class R>
HS_INLINE R interpolate(const Weights<R>& w, R value0, R delta1, R delta2) {
  if constexpr (mode == Interpolation::flat) {
    return value0;
  } else if constexpr (mode == Interpolation::linear) {
    return fma(w.b2, delta2, fma(w.b1, delta1, value0));
  } else {
    return fma(w.p2, delta2, fma(w.p1, delta1, value0));
  }
}

/// The component values of each lane's triangle, for the N components of a Varyings struct.
template <class R, std::size_t N>
struct ComponentLanes {
  std::array<R, N> value0;  ///< at v0; for flat components the triangle's one value
  std::array<R, N> delta1;  ///< value at v1 − value at v0
  std::array<R, N> delta2;  ///< value at v2 − value at v0
};

/// All components of the varyings V at weights w.
template <class V, class R, std::size_t... I>
HS_INLINE V interpolate_all(const Weights<R>& w, const ComponentLanes<R, sizeof...(I)>& c, std::index_sequence<I...>) {
  std::array<R, sizeof...(I)> out{interpolate<kInterpolations<V>[I]>(w, c.value0[I], c.delta1[I], c.delta2[I])...};
  return from_components<V, R>(out);
}

/// The same with the centroid components at weights of their own.
template <class V, class R, std::size_t... I>
HS_INLINE V interpolate_all(const Weights<R>& w, const Weights<R>& centroid, const ComponentLanes<R, sizeof...(I)>& c,
                            std::index_sequence<I...>) {
  constexpr auto modes = kInterpolations<V>;
  std::array<R, sizeof...(I)> out{
      interpolate<modes[I]>(modes[I] == Interpolation::centroid ? centroid : w, c.value0[I], c.delta1[I], c.delta2[I])...};
  return from_components<V, R>(out);
}

/// What a fragment shader is told of its pixel, lane by lane.
template <class R>
struct Pixel {
  R x, y;                  ///< window coordinates of the pixel centre (origin lower left, centres at +0.5)
  MaskOf<R> front_facing;  ///< the triangle is counter-clockwise (as DrawState::front says)

  /// Window depth of the fragment, in [0, 1]. Found when asked for: few shaders do.
  HS_INLINE R z() const { return find_z(*this); }
  /// 1/w_clip at the pixel.
  HS_INLINE R inv_w() const { return weights.denominator / triangle->area * triangle->q_unscale; }

  /// d/dx of a varying, per pixel: px.ddx(&Varyings<R>::uv). Exact by the triangle's plane, with no helper lanes.
  template <class V, class F>
  HS_INLINE F ddx(F V::*member) const {
    return derivative(member, dy, triangle->e1y, triangle->e2y, R(256));
  }
  /// d/dy of a varying, per pixel (y up).
  template <class V, class F>
  HS_INLINE F ddy(F V::*member) const {
    return derivative(member, dx, triangle->e1x, triangle->e2x, R(-256));
  }

  /// Where in a point's square the pixel lies: 0 to 1 from left to right and from the top to the bottom, or the bottom to the
  /// top (DrawState::point_origin). Of points alone.
  HS_INLINE vec2<R> point_coord() const { return {dx / triangle->e1x, dy / triangle->e2y}; }

  /// The varyings V at pixel (i, j) of the 2x2 quad that holds this pixel (i, j in {0, 1}; quads start at even window
  /// coordinates), by the same triangle, which need not cover it. For differences of computed values, as dFdx takes.
  template <class V>
  HS_INLINE V at_quad(int i, int j) const {
    const R to_x = (R(static_cast<float>(i)) - quad_x) * R(256);
    const R to_y = (R(static_cast<float>(j)) - quad_y) * R(256);
    const Weights<R> w = weights_at<kUsesNoPerspective<V>>(*triangle, dx + to_x, dy + to_y);
    return interpolate_all<V>(w, components<V>(), std::make_index_sequence<kComponents<V>>());
  }

  // Filled by the pipeline.
  const TriangleLanes<R>* triangle;
  const void* component_lanes;  ///< ComponentLanes<R, kComponents<V>> of the shader's Varyings V
  Weights<R> weights;
  R dx, dy;          ///< pixel centre − v0, in 1/256 px
  R quad_x, quad_y;  ///< 0 or 1: the pixel's place in its quad
  R (*find_z)(const Pixel&);
  const void* z_source;  ///< what find_z reads

 private:
  template <class V>
  HS_INLINE const ComponentLanes<R, kComponents<V>>& components() const {
    return *static_cast<const ComponentLanes<R, kComponents<V>>*>(component_lanes);
  }

  // Along x, dp1 = q1·(E1'·D − E1·D') / D². The terms with q1 drop out; E1 and E2 vanish together at v0, so
  // E1'·E2 − E1·E2' is A·(y − y0), and likewise with v2 for E0. With r = y − y0, r1 and r2 the edges' y,
  //   dp1 = q1·A·(q2·r − q0·(r − r2)) / D²,  dp2 = q2·A·(q0·(r − r1) − q1·r) / D²,
  // and along y the same of x with the other sign. Nothing is lost where w differs much from vertex to vertex.
  template <class V, class F>
  HS_INLINE F derivative(F V::*member, R r, R r1, R r2, R sub_pixels) const {
    using Traits = detail::FieldTraits<F>;
    static_assert(Traits::interpolation == Interpolation::smooth, "only smooth varyings have derivatives");
    const TriangleLanes<R>& t = *triangle;
    const R scale = sub_pixels * t.area * weights.inverse * weights.inverse;
    const R dp1 = t.q1 * scale * difference_of_products(t.q2, r, t.q0, r - r2);
    const R dp2 = t.q2 * scale * difference_of_products(t.q0, r - r1, t.q1, r);
    const std::size_t first = first_component(member);
    const auto& c = components<V>();
    std::array<R, Traits::components> out;
    for (std::size_t k = 0; k < Traits::components; ++k) {
      out[k] = fma(dp2, c.delta2[first + k], dp1 * c.delta1[first + k]);
    }
    return std::bit_cast<F>(out);
  }

  template <class V, class F>
  HS_INLINE static std::size_t first_component(F V::*member) {
    const V v{};
    const auto offset = reinterpret_cast<const char*>(&(v.*member)) - reinterpret_cast<const char*>(&v);
    return static_cast<std::size_t>(offset) / sizeof(R);
  }
};

}  // namespace halfspace
