// SPDX-License-Identifier: Apache-2.0
//
// The footprint of a pixel in a texture, and the number and size of the probes with which an anisotropic lookup covers it.
//
// The derivatives J = (∂st/∂x, ∂st/∂y), here in texels of level 0, map the square of the pixel to the texture. Its inscribed circle
// becomes an ellipse whose semi-axes are proportional to the singular values of J. EXT_texture_filter_anisotropic allows other
// approximations: its example uses the lengths of the columns of J, which is wrong for sheared footprints.
//
//   J·Jᵀ = (a b; b c),  m = (a + c)/2,  d = (a − c)/2:   major² = m + sqrt(d² + b²),  minor = |det J|/major
//   number of probes     N = min(ceil(major/minor), max_probes)
//   size of a probe      size = max(minor, major/N), and level of detail log2(size)
//
// The minor axis is at least one texel, since the texture has no finer detail. The N probes are spaced evenly along the major
// axis. The first and the last are at a distance of (major − size)/2 from the center, so that the probes together cover exactly
// the major axis. As the ratio of the axes approaches 1 the probes coincide, so there is no jump between one and two probes.
#pragma once

#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"

namespace halfspace::HS_LANES {

/// Returns OpenGL's ρ² (8.14.1): the square of the longer of the two texture-space steps of a pixel to the right and up, in texels of
/// a level 0 of width x height. NaN in duv_dx is ignored; NaN in duv_dy gives NaN.
template <Number R>
HS_INLINE R squared_scale_factor(int width, int height, const vec2<R>& duv_dx, const vec2<R>& duv_dy) {
  const R w(static_cast<float>(width)), h(static_cast<float>(height));
  const R ux = duv_dx.x * w, vx = duv_dx.y * h;
  const R uy = duv_dy.x * w, vy = duv_dy.y * h;
  return max(fma(ux, ux, vx * vx), fma(uy, uy, vy * vy));
}

/// Returns OpenGL's λ without bias, log2 ρ. Zero derivatives give −inf.
template <Number R>
HS_INLINE R level_of_detail(int width, int height, const vec2<R>& duv_dx, const vec2<R>& duv_dy) {
  return R(0.5f) * log2(squared_scale_factor(width, height, duv_dx, duv_dy));
}

template <class R>
struct Footprint {
  IntOf<R> probes;  ///< number of probes N >= 1
  R lod;            ///< level of detail of each probe; 0 if it has the size of a texel
  vec2<R> span;     ///< vector from the first probe to the last, in (s, t); 0 for a single one
};

/// Returns the footprint of a pixel in a level 0 of width x height. duv_dx and duv_dy are the changes in (s, t) to the next
/// pixel to the right and to the next pixel up. max_probes must be at least 1.
///
/// Even a circle has an axis ratio of 1 only up to rounding, so a ratio that exceeds an integer by a relative error of at most 1/1024
/// counts as that integer. A major axis that is longer than 2^30 texels, infinite or NaN gives one probe at level_of_detail.
template <Number R>
HS_INLINE Footprint<R> footprint(int width, int height, const vec2<R>& duv_dx, const vec2<R>& duv_dy, int max_probes) {
  const R w(static_cast<float>(width)), h(static_cast<float>(height)), one(1.0f), half(0.5f);
  const R ux = duv_dx.x * w, vx = duv_dx.y * h;
  const R uy = duv_dy.x * w, vy = duv_dy.y * h;
  const R a = fma(ux, ux, uy * uy), b = fma(ux, vx, uy * vy), c = fma(vx, vx, vy * vy);
  const R d = half * (a - c), root = sqrt(fma(d, d, b * b));
  const R major2 = fma(half, a + c, root);
  const R det = difference_of_products(ux, vy, uy, vx);
  const R minor2 = max(det * det / major2, one);  // NaN becomes 1
  const R ratio = sqrt(major2 / minor2);
  const R probes = clamp(-floor(-(ratio * R(1.0f - 0x1p-10f))), 1.0f, R(static_cast<float>(max_probes)));
  const R size2 = max(minor2, major2 / (probes * probes));
  // Direction of the major axis, an eigenvector of J·Jᵀ. It is computed from the row that does not suffer from cancellation.
  const MaskOf<R> flat = a >= c;
  const R x = select(flat, d + root, b), y = select(flat, b, root - d);
  const R stretch = sqrt(major2 / fma(x, x, y * y)) * (one - sqrt(size2 / major2));

  const MaskOf<R> sound = major2 <= R(0x1p60f), many = sound && probes > one;
  const vec2<R> span(select(many, x * stretch / w, R(0.0f)), select(many, y * stretch / h, R(0.0f)));
  const R lod = select(sound, half * log2(size2), level_of_detail(width, height, duv_dx, duv_dy));
  return {truncate_to_int(select(many, probes, one)), lod, span};
}

}  // namespace halfspace::HS_LANES
