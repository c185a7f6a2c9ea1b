// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/environment/sheen.h"

#include <cmath>
#include <span>
#include <vector>

#include "halfspace/core/float_mode.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/shading/light/ggx.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kColumns = 64, kRows = 32;         // of the table: n·v and roughness
constexpr int kElevations = 64, kAzimuths = 32;  // of the directions in the integral of an entry

// The fit of log Λ for cosines up to 0.5 (Conty Estevez and Kulla 2017, section 4), for one α.
template <class R>
struct MaskingFit {
  R a, b, c, d, e;

  explicit MaskingFit(R alpha) {
    const R rest = R(1) - alpha, t = rest * rest;
    const auto between = [&](float rough, float smooth) { return fma(R(smooth - rough), t, R(rough)); };
    a = between(21.5473f, 25.3245f);
    b = between(3.82987f, 3.32435f);
    c = between(0.19823f, 0.16801f);
    d = between(-1.97760f, -1.27393f);
    e = between(-4.32054f, -4.85967f);
  }
  R log_of(R cosine) const { return a / (R(1) + b * pow(cosine, c)) + d * cosine + e; }
  // Λ. The fit is continued to cosines above 0.5 by symmetry.
  R of(R cosine) const {
    const R near = log_of(min(cosine, max(R(1) - cosine, R(0))));  // cosines of unit vectors may exceed 1 by rounding
    return exp(select(cosine < R(0.5f), near, R(2) * log_of(R(0.5f)) - near));
  }
};

// The reflection for one α.
template <class R>
struct SheenLobe {
  MaskingFit<R> masking;
  R exponent;

  explicit SheenLobe(R alpha) : masking(alpha), exponent(R(1) / alpha) {}
  // Returns π·D·V·n·l. masking_v, masking_l: Λ of the view and light directions.
  R reflection(R sine_h, R masking_v, R masking_l, R n_v) const {
    const R distribution = R(0.5f) * (R(2) + exponent) * unit_pow(min(sine_h, R(1)), exponent);
    return distribution / ((R(1) + masking_v + masking_l) * (R(4) * n_v));
  }
};

template <class R>
R alpha_of(R roughness) {
  const R r = clamp(roughness, R(kMinRoughness), R(1));
  return r * r;
}

// Integrates over the part of the hemisphere on one side of the plane of view and normal; the other part reflects the same. For lanes of
// n·v. azimuths: cosines and sines.
Real integrated_sheen(float roughness, Real n_v, std::span<const glm::vec2> azimuths) {
  const SheenLobe<Real> lobe(alpha_of(Real(roughness)));
  const Real v_x = sqrt(max(fma(-n_v, n_v, Real(1.0f)), Real(0.0f))), masking_v = lobe.masking.of(n_v);
  Real sum(0.0f);
  for (int i = 0; i < kElevations; ++i) {
    const float n_l = (static_cast<float>(i) + 0.5f) / kElevations, radius = std::sqrt(1.0f - n_l * n_l);
    const Real masking_l = lobe.masking.of(Real(n_l)), up = n_v + Real(n_l);
    for (const glm::vec2& azimuth : azimuths) {
      const Real x = v_x + Real(radius * azimuth.x), y(radius * azimuth.y), side = fma(x, x, y * y);
      sum += lobe.reflection(sqrt(side / fma(up, up, side)), masking_v, masking_l, n_v);
    }
  }
  return sum * Real(2.0f / (kElevations * kAzimuths));
}

const Texture2D& sheen_table() {
  const FloatMode float_mode;
  static const Texture2D table = [] {
    std::vector<glm::vec2> azimuths;
    for (int j = 0; j < kAzimuths; ++j) {
      const SinCosDouble a = sincos_turns((j + 0.5) / (2.0 * kAzimuths));
      azimuths.emplace_back(static_cast<float>(a.cos), static_cast<float>(a.sin));
    }
    Image<glm::vec4> image(kColumns, kRows);
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; x += kLanes) {
        const Real n_v = (to_real<Real>(iota<IntOf<Real>>() + IntOf<Real>(x)) + Real(0.5f)) * Real(1.0f / kColumns);
        const Real sheen = min(integrated_sheen((static_cast<float>(y) + 0.5f) / kRows, n_v, azimuths), Real(1.0f));
        for (int k = 0; k < kLanes; ++k) image.at(x + k, y) = glm::vec4(lane(sheen, k));
      }
    }
    return Texture2D(std::span<const Image<glm::vec4>>(&image, 1), TexelFormat::rgba32f);
  }();
  return table;
}

}  // namespace

template <class R>
R sheen_reflection(R roughness, R sine_h, R n_l, R n_v) {
  const SheenLobe<R> lobe(alpha_of(roughness));
  return lobe.reflection(sine_h, lobe.masking.of(n_v), lobe.masking.of(n_l), n_v);
}

template <class R>
R directional_sheen(R roughness, R n_v) {
  constexpr Sampler kSampler{.mag = Filter::bilinear, .min = Filter::bilinear, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};
  return sheen_table().sample_level<R>(kSampler, vec2<R>(n_v, roughness), R(0.0f)).x;
}

template <class R>
vec3<R> with_sheen(const vec3<R>& below, const SheenLayer<R>& sheen, const SurfacePoint<R>& p, const LightRange& lights,
                   const vec3<R>& around) {
  const R n_v = max(dot(p.n_ws, p.v_ws), R(1e-4f)), total = directional_sheen(sheen.roughness, n_v);
  const SheenLobe<R> lobe(alpha_of(sheen.roughness));
  const R masking_v = lobe.masking.of(n_v);
  vec3<R> reflected = around * total;
  for (const Light& light : lights) {
    const IncidentLight<R> arriving = light_at(light, p.position_rws);
    const R n_l = dot(p.n_ws, arriving.l_ws);
    if (!any(n_l > R(0))) continue;
    R received = arriving.strength;
    if (light.shadow != nullptr) received *= shadow_factor(*light.shadow, shadow_receiver(p, arriving.l_ws));
    const vec3<R> sine = cross(p.n_ws, normalize_or_zero(arriving.l_ws + p.v_ws));
    const R share = lobe.reflection(sqrt(dot(sine, sine)), masking_v, lobe.masking.of(max(n_l, R(1e-6f))), n_v);
    reflected += light.specular * select(n_l > R(0), received * share, R(0));
  }
  const R largest = max(sheen.color.x, max(sheen.color.y, sheen.color.z));
  return below * (R(1) - min(largest * total, R(1))) + sheen.color * reflected;
}

template vec3<float> with_sheen(const vec3<float>&, const SheenLayer<float>&, const SurfacePoint<float>&, const LightRange&,
                                const vec3<float>&);
template vec3<double> with_sheen(const vec3<double>&, const SheenLayer<double>&, const SurfacePoint<double>&, const LightRange&,
                                 const vec3<double>&);
template vec3<FragmentReal> with_sheen(const vec3<FragmentReal>&, const SheenLayer<FragmentReal>&, const SurfacePoint<FragmentReal>&,
                                       const LightRange&, const vec3<FragmentReal>&);

template float sheen_reflection(float, float, float, float);
template double sheen_reflection(double, double, double, double);
template float directional_sheen(float, float);
template double directional_sheen(double, double);
#if HALFSPACE_LANES > 1
template Real sheen_reflection(Real, Real, Real, Real);
template Real directional_sheen(Real, Real);
template vec3<Real> with_sheen(const vec3<Real>&, const SheenLayer<Real>&, const SurfacePoint<Real>&, const LightRange&, const vec3<Real>&);
#endif

}  // namespace halfspace::HS_LANES
