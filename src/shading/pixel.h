// SPDX-License-Identifier: Apache-2.0
//
// Interpolation of varyings, and the pixel information that is available to fragment shaders.
//
// The input is a triangle per lane (snapped positions, 1/w, component values) and a pixel position. The output is the
// perspective-correct weights, the interpolated components, their exact derivatives, and values at other pixels of the 2x2 quad.
//
// Let d = p − v0, e1 = v1 − v0, e2 = v2 − v0 in units of 1/256 px (integers, exact in a float), and
//   E0 = (e1 − d) × (e2 − d),  E1 = d × e2,  E2 = e1 × d,  A = e1 × e2 = E0 + E1 + E2,
// so that E0/A, E1/A and E2/A are the barycentric weights. With q = 1/w the perspective-correct weights (OpenGL 4.6, section
// 14.6.1, equation 14.9) are
//   pi = Ei·qi / D,  D = E0·q0 + E1·q1 + E2·q2.
// Inside the triangle every term of D is non-negative, and the 2x2 determinants are computed by difference_of_products. There is
// no cancellation, for any shape of the triangle and any ratio of w. A value is a = a0 + p1·(a1 − a0) + p2·(a2 − a0), which
// reproduces constants exactly but can double an error of the weights. `normalized` therefore removes the rounding errors of the
// division and the sum from the weights. The error of a is then less than 3e-7 of the largest |ai|.
//
// If w is the same at all vertices of a large triangle, a is linear in the window, and no division is needed. Such a triangle is given as
// planes (TriangleLanes::planar): v0 is then a point near the pixel (raster/shade/plane_anchor.h), d is the offset from it, and
//   a = a0 + dx·(∂a/∂x) + dy·(∂a/∂y).
#pragma once

#include <array>
#include <type_traits>

#include "halfspace/shading/sample_positions.h"
#include "halfspace/shading/varyings.h"

namespace halfspace::HS_LANES {

/// The triangle of each lane, prepared for interpolation. Positions are window coordinates in 24.8 fixed point.
template <class R>
struct TriangleLanes {
  R x0, y0;              ///< v0, or the anchor of planes, in 1/256 px: an integer with |x| ≤ 2^22, stored as float
  R e1x, e1y, e2x, e2y;  ///< edge vectors from v0 in 1/256 px
  R area;                ///< A > 0, in (1/256 px)²
  R q0, q1, q2;          ///< 1/w of the vertices times q_scale; the largest is in [1, 2)
  R q_unscale;           ///< 1/q_scale, a power of two
  /// The lanes whose triangle is given as planes: q0 is their 1/w, the area is 1 and the edges are not used.
  MaskOf<R> planar{false};
};

/// Interpolation weights at a point of the triangle. For planes, they are the offset from the anchor.
template <class R>
struct Weights {
  R p1, p2;       ///< perspective-correct weights of v1, v2
  R b1, b2;       ///< linear weights of v1, v2 in window space; equal to p1 and p2 if no varying needs them
  R denominator;  ///< D as defined above; 1/w at the point is D / A · q_unscale
  R p1_x, p2_x;   ///< derivatives of p1 and p2 along x, per pixel
  R p1_y, p2_y;   ///< the same along y
};

/// n1 and n2 divided by the sum of n0, n1 and n2. Because the sum and the quotients are rounded, the three weights do not add up to
/// exactly 1. The difference is distributed in proportion to the weights. It is computed from 1 − max(p1, p2), which is exact if
/// the maximum is at least 1/2. This is the case in which the accuracy of the difference matters.
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

/// The derivatives of the perspective-correct weights along one axis, per pixel.
template <class R>
struct WeightSlopes {
  R p1, p2;
};
/// Returns the derivatives along x. For those along y, exchange the roles of x and y, and pass a negative sub_pixels. inverse: 1 / D; r:
/// the y offset from v0; r1 and r2: the y components of the edges; sub_pixels: sub-pixels per pixel.
///
/// Along x, dp1 = q1·(E1'·D − E1·D') / D². The terms with q1 cancel. E1 and E2 both vanish at v0, so E1'·E2 − E1·E2' is A·(y − y0), and
/// likewise at v2 for E0. Therefore
///   dp1 = q1·A·(q2·r − q0·(r − r2)) / D²,  dp2 = q2·A·(q0·(r − r1) − q1·r) / D².
/// No accuracy is lost if w differs strongly between vertices.
template <class R>
HS_INLINE WeightSlopes<R> weight_slopes(const TriangleLanes<R>& t, R inverse, R r, R r1, R r2, R sub_pixels) {
  const R scale = sub_pixels * t.area * inverse * inverse;
  return {t.q1 * scale * difference_of_products(t.q2, r, t.q0, r - r2), t.q2 * scale * difference_of_products(t.q0, r - r1, t.q1, r)};
}

/// Returns the weights at the offset (dx, dy) from v0 of triangles that are not given as planes.
template <bool linear, class R>
HS_INLINE Weights<R> perspective_weights_at(const TriangleLanes<R>& t, R dx, R dy) {
  const R e0 = difference_of_products(t.e1x - dx, t.e2y - dy, t.e1y - dy, t.e2x - dx);
  const R e1 = difference_of_products(dx, t.e2y, dy, t.e2x);
  const R e2 = difference_of_products(t.e1x, dy, t.e1y, dx);
  const Normalized<R> p = normalized(e0 * t.q0, e1 * t.q1, e2 * t.q2);
  const Normalized<R> b = linear ? normalized(e0, e1, e2) : p;
  const WeightSlopes<R> x = weight_slopes(t, p.inverse, dy, t.e1y, t.e2y, R(256)),
                        y = weight_slopes(t, p.inverse, dx, t.e1x, t.e2x, R(-256));
  return {p.p1, p.p2, b.p1, b.p2, p.sum, x.p1, x.p2, y.p1, y.p2};
}

/// Returns the weights at the offset (dx, dy) from v0. linear: also compute the linear weights in window space.
template <bool linear = true, class R>
HS_INLINE Weights<R> weights_at(const TriangleLanes<R>& t, R dx, R dy) {
  const Weights<R> plane{dx, dy, dx, dy, t.q0, R(256), R(0), R(0), R(256)};
  if (all(t.planar)) return plane;
  const Weights<R> w = perspective_weights_at<linear>(t, dx, dy);
  if (!any(t.planar)) return w;
  const auto pick = [&](R of_plane, R other) { return select(t.planar, of_plane, other); };
  return {pick(plane.p1, w.p1),
          pick(plane.p2, w.p2),
          pick(plane.b1, w.b1),
          pick(plane.b2, w.b2),
          pick(plane.denominator, w.denominator),
          pick(plane.p1_x, w.p1_x),
          pick(plane.p2_x, w.p2_x),
          pick(plane.p1_y, w.p1_y),
          pick(plane.p2_y, w.p2_y)};
}

/// Interpolates one component, given its value at v0 and the differences to v1 and v2.
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

/// The component values of the triangle in each lane, for the N components of a Varyings struct.
template <class R, std::size_t N>
struct ComponentLanes {
  std::array<R, N> value0;  ///< at v0 or the anchor; for flat components the value of the provoking vertex
  std::array<R, N> delta1;  ///< value at v1 − value at v0; for planes, the derivative along x per 1/256 px
  std::array<R, N> delta2;  ///< value at v2 − value at v0; for planes, the derivative along y per 1/256 px
};

/// Interpolates all components of the varyings V with weights w.
template <class V, class R, std::size_t... I>
HS_INLINE V interpolate_all(const Weights<R>& w, const ComponentLanes<R, sizeof...(I)>& c, std::index_sequence<I...>) {
  std::array<R, sizeof...(I)> out{interpolate<kInterpolations<V>[I]>(w, c.value0[I], c.delta1[I], c.delta2[I])...};
  return from_components<V, R>(out);
}

/// The same, with separate weights for centroid components.
template <class V, class R, std::size_t... I>
HS_INLINE V interpolate_all(const Weights<R>& w, const Weights<R>& centroid, const ComponentLanes<R, sizeof...(I)>& c,
                            std::index_sequence<I...>) {
  constexpr auto modes = kInterpolations<V>;
  std::array<R, sizeof...(I)> out{
      interpolate<modes[I]>(modes[I] == Interpolation::centroid ? centroid : w, c.value0[I], c.delta1[I], c.delta2[I])...};
  return from_components<V, R>(out);
}

/// Per-pixel information for a fragment shader.
template <class R>
struct Pixel {
  R x, y;                  ///< window coordinates (origin lower left) of the pixel center, or of the sample with per-sample shading
  MaskOf<R> front_facing;  ///< the winding matches DrawState::front; always true for point and line primitives
  /// The number of the sample if the fragment function runs once per sample, otherwise 0 (gl_SampleID). It runs so with
  /// DrawState::sample_shading, with a PerSample varying, or for shaders with `static constexpr bool per_sample = true`.
  int32_t sample = 0;
  int32_t samples = 1;  ///< number of samples of a pixel (gl_NumSamples)

  /// Returns the window depth of the fragment, in [0, 1]. It is computed on demand, because few shaders need it.
  HS_INLINE R z() const { return find_z(*this); }
  /// Returns the position of (x, y) in its pixel, in [0, 1) (gl_SamplePosition).
  HS_INLINE vec2<R> sample_position() const { return {x - floor(x), y - floor(y)}; }
  /// Returns the samples of the pixel that the primitive covers and DrawState::sample_mask enables (gl_SampleMaskIn): bit s is sample s. If
  /// the fragment function runs once per sample, it is at most the bit of this sample. Computed on demand.
  HS_INLINE IntOf<R> sample_mask() const { return find_sample_mask(*this); }
  /// Returns 1/w_clip at the pixel.
  HS_INLINE R inv_w() const { return weights.denominator / triangle->area * triangle->q_unscale; }

  /// Returns d/dx of a varying, per pixel: px.ddx(&Varyings<R>::uv). It is computed exactly from the plane of the triangle, without
  /// helper lanes.
  template <class V, class F>
  HS_INLINE F ddx(F V::*member) const {
    return derivative(member, weights.p1_x, weights.p2_x);
  }
  /// Returns d/dy of a varying, per pixel; y points up.
  template <class V, class F>
  HS_INLINE F ddy(F V::*member) const {
    return derivative(member, weights.p1_y, weights.p2_y);
  }

  /// Returns the position of the pixel within a point, from 0 to 1: left to right, and top to bottom or bottom to top as set by
  /// DrawState::point_origin. Valid only for points.
  HS_INLINE vec2<R> point_coord() const { return {dx / triangle->e1x, dy / triangle->e2y}; }

  /// Returns the varyings V at pixel (i, j) of the 2x2 quad that contains this pixel, where i and j are 0 or 1 and quads start at even
  /// window coordinates. They are extrapolated if the triangle does not cover that pixel. Used for differences of computed values,
  /// like dFdx in GLSL.
  template <class V>
  HS_INLINE V at_quad(int i, int j) const {
    const R to_x = (R(static_cast<float>(i)) - quad_x) * R(256);
    const R to_y = (R(static_cast<float>(j)) - quad_y) * R(256);
    const Weights<R> w = weights_at<kUsesNoPerspective<V>>(*triangle, dx + to_x, dy + to_y);
    return interpolate_all<V>(w, components<V>(), std::make_index_sequence<kComponents<V>>());
  }

  /// Returns the varyings V at an offset from the pixel center, in pixels with y up (interpolateAtOffset). They are extrapolated if the
  /// triangle does not cover that point.
  template <class V>
  HS_INLINE V at_offset(const vec2<R>& offset) const {
    const vec2<R> from_center = sample_position() - vec2<R>(R(0.5f), R(0.5f));
    const Weights<R> w =
        weights_at<kUsesNoPerspective<V>>(*triangle, dx + (offset.x - from_center.x) * R(256), dy + (offset.y - from_center.y) * R(256));
    return interpolate_all<V>(w, components<V>(), std::make_index_sequence<kComponents<V>>());
  }
  /// Returns the varyings V at a sample, from 0 to samples − 1 (interpolateAtSample); with one sample, always at the pixel center.
  template <class V>
  HS_INLINE V at_sample(int number) const {
    const SamplePosition p = HS_LANES::sample_position(samples, samples == 1 ? 0 : number);
    const auto from_center = [](int at) { return R(static_cast<float>(at - kPixelCenter.x) / 256.0f); };
    return at_offset<V>({from_center(p.x), from_center(p.y)});
  }

  /// Return the change of a value to the next pixel to the right and up, within the 2x2 quad, like dFdxCoarse and dFdyCoarse in GLSL:
  /// px.template quad_ddx<Varyings<R>>([&](const auto& v) { return v.uv * scale; }). f computes the value from varyings.
  template <class V, class F>
  HS_INLINE auto quad_ddx(const F& f) const {
    return f(at_quad<V>(1, 0)) - f(at_quad<V>(0, 0));
  }
  template <class V, class F>
  HS_INLINE auto quad_ddy(const F& f) const {
    return f(at_quad<V>(0, 1)) - f(at_quad<V>(0, 0));
  }

  // Set by the pipeline.
  const TriangleLanes<R>* triangle;
  const void* component_lanes;  ///< ComponentLanes<R, kComponents<V>> of the shader's Varyings V
  Weights<R> weights;
  R dx, dy;          ///< pixel position − v0 or the anchor, in 1/256 px
  R quad_x, quad_y;  ///< 0 or 1: position of the pixel within its quad
  R (*find_z)(const Pixel&);
  IntOf<R> (*find_sample_mask)(const Pixel&) = [](const Pixel&) { return IntOf<R>(1); };
  const void* z_source;  ///< data for find_z and find_sample_mask

 private:
  template <class V>
  HS_INLINE const ComponentLanes<R, kComponents<V>>& components() const {
    return *static_cast<const ComponentLanes<R, kComponents<V>>*>(component_lanes);
  }

  template <class V, class F>
  HS_INLINE F derivative(F V::*member, R dp1, R dp2) const {
    using Traits = detail::FieldTraits<F>;
    static_assert(Traits::interpolation == Interpolation::smooth, "only smooth varyings have derivatives");
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

/// Places a pixel of a shader with the varyings V on a triangle, which must outlive it, as must the components. (x, y): window coordinates
/// in 1/256 px; odd_x, odd_y: 1 in odd columns and rows of pixels, otherwise 0. Sets neither the sample nor the facing nor find_z().
template <class V, class R>
HS_INLINE void place_pixel(Pixel<R>& px, const TriangleLanes<R>& triangle, const ComponentLanes<R, kComponents<V>>& components, R x, R y,
                           R odd_x, R odd_y) {
  px.dx = x - triangle.x0;
  px.dy = y - triangle.y0;
  px.triangle = &triangle;
  px.component_lanes = &components;
  px.weights = weights_at<kUsesNoPerspective<V>>(triangle, px.dx, px.dy);
  px.x = x * R(1.0f / 256.0f);
  px.y = y * R(1.0f / 256.0f);
  px.quad_x = odd_x;
  px.quad_y = odd_y;
}

}  // namespace halfspace::HS_LANES
