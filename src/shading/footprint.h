// SPDX-License-Identifier: Apache-2.0
//
// What a pixel covers in a texture, and with how many probes of which size an anisotropic look-up covers that.
//
// The pixel's square is mapped by the derivatives J = (∂st/∂x, ∂st/∂y), here in texels of level 0. The circle in it becomes an
// ellipse; its axes are the singular values of J. EXT_texture_filter_anisotropic leaves an implementation free in how it
// finds them: its example takes the lengths of the columns of J instead, which misjudges sheared footprints.
//
//   J·Jᵀ = (a b; b c),  m = (a + c)/2,  d = (a − c)/2:   major² = m + sqrt(d² + b²),  minor = |det J|/major
//   number of probes     N = min(ceil(major/minor), most)
//   size of a probe      size = max(minor, major/N), and level of detail log2(size)
//
// The shorter axis counts as a texel at least: nothing finer is known. The N probes stand evenly along the longer axis, the first
// and the last (major − size)/2 from the centre, so that together, each covering its size, they cover the longer axis
// and no more. So where the ratio of the axes tends to 1 the probes meet, and nothing jumps between one and two.
#pragma once

#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"

namespace halfspace {

/// GL's ρ² (8.14.1): the square of the longer of the two lengths that a pixel step to the right or up covers, in texels of a level 0
/// of width × height. A step to the right with a NaN in it is passed over, one up gives NaN.
template <Number R>
HS_INLINE R squared_scale_factor(int width, int height, const vec2<R>& duv_dx, const vec2<R>& duv_dy) {
  const R w(static_cast<float>(width)), h(static_cast<float>(height));
  const R ux = duv_dx.x * w, vx = duv_dx.y * h;
  const R uy = duv_dy.x * w, vy = duv_dy.y * h;
  return max(fma(ux, ux, vx * vx), fma(uy, uy, vy * vy));
}

/// GL's λ without bias, log2 ρ. Zero derivatives give −inf.
template <Number R>
HS_INLINE R level_of_detail(int width, int height, const vec2<R>& duv_dx, const vec2<R>& duv_dy) {
  return R(0.5f) * log2(squared_scale_factor(width, height, duv_dx, duv_dy));
}

template <class R>
struct Footprint {
  IntOf<R> probes;  ///< N >= 1
  R lod;            ///< of each probe; 0 where it is the size of a texel
  vec2<R> span;     ///< from the first probe to the last, in (s, t); 0 for a single one
};

/// The footprint in a level 0 of width × height of a pixel whose steps change (s, t) by duv_dx and duv_dy; most >= 1.
///
/// A ratio of axes up to 1/1024 above a whole number counts as that number: the ratio of a circle is 1 but for rounding. A
/// longer axis above 2^30 texels, infinite or NaN gives one probe at level_of_detail.
template <Number R>
HS_INLINE Footprint<R> footprint(int width, int height, const vec2<R>& duv_dx, const vec2<R>& duv_dy, int max_probes) {
  const R w(static_cast<float>(width)), h(static_cast<float>(height)), one(1.0f), half(0.5f);
  const R ux = duv_dx.x * w, vx = duv_dx.y * h;
  const R uy = duv_dy.x * w, vy = duv_dy.y * h;
  const R a = fma(ux, ux, uy * uy), b = fma(ux, vx, uy * vy), c = fma(vx, vx, vy * vy);
  const R d = half * (a - c), root = sqrt(fma(d, d, b * b));
  const R major2 = fma(half, a + c, root);
  const R det = difference_of_products(ux, vy, uy, vx);
  const R minor2 = max(det * det / major2, one);  // NaN: one
  const R ratio = sqrt(major2 / minor2);
  const R probes = clamp(-floor(-(ratio * R(1.0f - 0x1p-10f))), 1.0f, R(static_cast<float>(max_probes)));
  const R size2 = max(minor2, major2 / (probes * probes));
  // The longer axis's direction, an eigenvector of J·Jᵀ, from the row whose numbers do not cancel.
  const MaskOf<R> flat = a >= c;
  const R x = select(flat, d + root, b), y = select(flat, b, root - d);
  const R stretch = sqrt(major2 / fma(x, x, y * y)) * (one - sqrt(size2 / major2));

  const MaskOf<R> sound = major2 <= R(0x1p60f), many = sound && probes > one;
  const vec2<R> span(select(many, x * stretch / w, R(0.0f)), select(many, y * stretch / h, R(0.0f)));
  const R lod = select(sound, half * log2(size2), level_of_detail(width, height, duv_dx, duv_dy));
  return {truncate_to_int(select(many, probes, one)), lod, span};
}

}  // namespace halfspace
