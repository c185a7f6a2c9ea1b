// SPDX-License-Identifier: Apache-2.0
//
// The sheen of cloth: light that fibers scatter towards grazing directions (KHR_materials_sheen). The reflection is D·V with
//
//   D = (2 + 1/α) sin(θ)^(1/α) / (2π)            θ is the angle between the normal and the half vector
//   V = 1 / ((1 + Λ(n·v) + Λ(n·l)) 4 n·v n·l)    Λ is a fit to measured masking
//
// where α = roughness². A. Conty Estevez and C. Kulla, "Production friendly microfacet sheen BRDF", SIGGRAPH 2017.
//
// The functions are instantiated in sheen.cpp. Few materials have sheen, so it is not compiled into every kernel.
#pragma once

#include "halfspace/shading/light/lighting.h"

namespace halfspace::HS_LANES {

/// Returns π·D·V·n·l: the reflection of a light of strength 1 by white sheen, in the convention of ggx_reflection. sine_h: sin θ. n_l and
/// n_v are positive. roughness is clamped to [kMinRoughness, 1].
template <class R>
R sheen_reflection(R roughness, R sine_h, R n_l, R n_v);

/// Looks up the integral of D·V·n·l over all directions of incident light, in a table that is computed on the first call. The error is
/// below 0.02 for n_v ≥ 0.1. The integral exceeds 1 at grazing views of smooth sheen, where the fit does not conserve energy; there,
/// the result is 1. roughness and n_v are clamped to [0, 1].
template <class R>
R directional_sheen(R roughness, R n_v);

/// Sheen at a pixel.
template <class R>
struct SheenLayer {
  vec3<R> color;
  R roughness;
};

/// Returns the light that leaves a surface with sheen. below: the light that the surface would reflect and emit without it. Sheen transmits
/// the part 1 − E(n·v) of it, where E is the integral of its own reflection; the extension permits this simplification. around: light from
/// all directions, as a white diffuse surface would reflect it. Available for R = float, double, Real and FragmentReal.
template <class R>
vec3<R> with_sheen(const vec3<R>& below, const SheenLayer<R>& sheen, const SurfacePoint<R>& p, const LightRange& lights,
                   const vec3<R>& around);

}  // namespace halfspace::HS_LANES
