// SPDX-License-Identifier: Apache-2.0
//
// Image-based lighting of metallic-roughness surfaces by the split-sum approximation (B. Karis, "Real shading in Unreal Engine 4", SIGGRAPH
// 2013): an environment map that is prefiltered for the lobes of several roughnesses is multiplied by the reflectance of the surface,
// integrated over all directions. Light that microfacets scatter several times is added by the method of C. Fdez-Agüera, "A
// multiple-scattering microfacet model for real-time image based lighting", JCGT 8(1), 2019. Diffuse light is represented by nine spherical
// harmonics (R. Ramamoorthi and P. Hanrahan, "An efficient representation for irradiance environment maps", SIGGRAPH 2001).
#pragma once

#include <array>

#include "halfspace/core/parallel.h"
#include "halfspace/shading/environment/environment.h"
#include "halfspace/shading/light/lighting.h"

namespace halfspace::HS_LANES {

/// An environment map prefiltered for rough surfaces, in the map space of the environment.
struct FilteredEnvironment {
  static constexpr int kLevels = 6;  ///< of `radiance`: level i is prefiltered for the roughness i / (kLevels − 1)

  EnvironmentMap radiance;
  std::array<glm::vec3, 9> harmonics;  ///< irradiance / π = Σ harmonics[i]·basis i, with the constants of the basis included

  /// Prefilters a map. size: face width of level 0, a power of two that is at least 2^kLevels. The result is bit-identical for any number
  /// of workers and any SIMD width. Uniform maps need no filtering, because their light is the same in every lobe.
  FilteredEnvironment(const EnvironmentMap& map, int size, const Workers& workers);

  /// Returns irradiance / π at a surface with the unit normal n_ms.
  template <class R>
  HS_INLINE vec3<R> diffuse(const vec3<R>& n_ms) const {
    const R &x = n_ms.x, &y = n_ms.y, &z = n_ms.z;
    const std::array<R, 9> basis{R(1), y, z, x, x * y, y * z, fma(R(3) * z, z, R(-1)), x * z, x * x - y * y};
    vec3<R> sum(R(0));
    for (std::size_t i = 0; i < 9; ++i) sum += harmonics[i] * basis[i];
    return {max(sum.x, R(0)), max(sum.y, R(0)), max(sum.z, R(0))};
  }
  /// Returns the light that a lobe of the given roughness around r_ms receives.
  template <class R>
  HS_INLINE vec3<R> specular(const vec3<R>& r_ms, R roughness) const {
    return radiance.sample_level<R>(r_ms, roughness * R(static_cast<float>(kLevels - 1)));
  }

 private:
  FilteredEnvironment(const std::vector<std::array<Image<glm::vec4>, 6>>& levels, const Workers& workers);
};

/// A prefiltered environment with its orientation and brightness.
struct EnvironmentLight {
  const FilteredEnvironment* map = nullptr;  ///< not owned
  glm::mat3 map_from_world = kMapFromWorld;
  float brightness = 1.0f;
};

/// Diffuse and specular light of an environment at a point.
template <class R>
struct AmbientLight {
  vec3<R> diffuse, specular;
};

/// A blend of two prefiltered environments. An environment with weight 0 is not read.
struct EnvironmentLightBlend {
  EnvironmentLight first, second;
  float weight = 0.0f;  ///< weight of the second, 0 to 1

  /// n_ws and v_ws: unit vectors along the normal and towards the eye. The lobe of a rough surface points between the reflected view
  /// direction and the normal (S. Lagarde and C. de Rousiers, "Moving Frostbite to physically based rendering", 2014, section 4.9.3).
  template <class R>
  HS_INLINE AmbientLight<R> at(const vec3<R>& n_ws, const vec3<R>& v_ws, R roughness) const {
    const R alpha = roughness * roughness, smooth = R(1) - alpha;
    const vec3<R> r_ws = mix(n_ws, reflect(-v_ws, n_ws), smooth * (sqrt(smooth) + alpha));
    AmbientLight<R> sum{vec3<R>(R(0)), vec3<R>(R(0))};
    for (const auto& [light, share] : {std::pair(&first, 1.0f - weight), std::pair(&second, weight)}) {
      if (share <= 0.0f) continue;
      const R scale(share * light->brightness);
      sum.diffuse += light->map->template diffuse<R>(light->map_from_world * n_ws) * scale;
      sum.specular += light->map->template specular<R>(light->map_from_world * r_ws, roughness) * scale;
    }
    return sum;
  }
  /// Returns only the diffuse light.
  template <class R>
  HS_INLINE vec3<R> diffuse_at(const vec3<R>& n_ws) const {
    vec3<R> sum(R(0));
    for (const auto& [light, share] : {std::pair(&first, 1.0f - weight), std::pair(&second, weight)}) {
      if (share > 0.0f) sum += light->map->template diffuse<R>(light->map_from_world * n_ws) * R(share * light->brightness);
    }
    return sum;
  }
};

/// The integral of the GGX reflection over all directions of incident light, as two parts: the factor of F0 and the factor of F90.
template <class R>
struct DirectionalReflectance {
  R f0, f90;
};

/// Looks up the integral in a table that is computed on the first call. The error is below 0.02. roughness and n_v are clamped to [0, 1].
template <class R>
DirectionalReflectance<R> directional_reflectance(R roughness, R n_v);

}  // namespace halfspace::HS_LANES
