// SPDX-License-Identifier: Apache-2.0
//
// The reflection model of metallic-roughness materials, as glTF 2.0 (appendix B) describes it: a GGX microfacet distribution with
// height-correlated Smith masking-shadowing and Schlick's approximation of the Fresnel term, over a Lambert base.
//
//   D = α² / (π ((n·h)² (α² − 1) + 1)²)
//   V = 1 / (2 (n·l √((n·v)² (1 − α²) + α²) + n·v √((n·l)² (1 − α²) + α²)))
//   F = F0 + (F90 − F0) (1 − v·h)⁵
//
// where α = roughness². B. Walter et al., "Microfacet models for refraction through rough surfaces", EGSR 2007; E. Heitz, "Understanding
// the masking-shadowing function in microfacet-based BRDFs", JCGT 3(2), 2014; C. Schlick, "An inexpensive BRDF model for physically-based
// rendering", 1994.
#pragma once

#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"

namespace halfspace::HS_LANES {

/// Smaller values of roughness are clamped to this one, so that the highlight of a point light stays finite and visible.
inline constexpr float kMinRoughness = 0.045f;

/// Returns π·D·V·n·l: the reflection of a light of strength 1, before the Fresnel term. The factor π matches the convention of Light, under
/// which a white diffuse surface that faces a light of strength 1 reflects 1. n and h are unit vectors; n_l and n_v are positive. If the
/// light is exactly opposite to the eye, the half vector h is zero, and the result is 0.
template <Number R>
HS_INLINE R ggx_reflection(R alpha, const vec3<R>& n, const vec3<R>& h, R n_l, R n_v) {
  const R a2 = alpha * alpha, n_h = dot(n, h);
  const vec3<R> sine = cross(n, h);  // 1 − (n·h)² would suffer from cancellation at small angles
  // (n·h)² (α² − 1) + 1, which is at least α². It is 0 if h is zero.
  const R d = fma(a2 * n_h, n_h, dot(sine, sine));
  const R rest = R(1) - a2;
  const R masking = n_l * sqrt(fma(n_v * n_v, rest, a2)) + n_v * sqrt(fma(n_l * n_l, rest, a2));
  return select(d > R(0), R(0.5f) * n_l * (a2 / (d * d)) / masking, R(0));
}

/// Returns the factor (1 − cosine)⁵ of Schlick's Fresnel approximation. cosine must be at most 1.
template <Number R>
HS_INLINE R schlick_weight(R cosine) {
  const R x = clamp(R(1) - cosine, R(0), R(1)), x2 = x * x;
  return x2 * x2 * x;
}

}  // namespace halfspace::HS_LANES
