// SPDX-License-Identifier: Apache-2.0
//
// The common part of shaders for surfaces with ambient, diffuse and specular factors.
//
//   color = color · (ambient + diffuse · D) + specular · S + emissive + reflection · M
//
// where D and S are the diffuse and specular light of shading/light/lighting.h, and M is the reflected light of the environment
// (shading/environment/reflection.h; only for per-pixel shading). Each factor except reflection is a constant, multiplied by a map if set.
#pragma once

#include <array>

#include "halfspace/shading/environment/environment.h"
#include "halfspace/shading/surface/surface_uniforms.h"

namespace halfspace::HS_LANES {

/// The factors of a material.
enum MaterialFactor : uint8_t { kColor, kAmbient, kDiffuse, kSpecular, kEmissive, kShininess };
inline constexpr std::size_t kMaterialFactors = 6;

/// A material factor as a linear color. Only the first component of kShininess is used.
struct Factor {
  glm::vec3 constant{1.0f};
  const Texture2D* map = nullptr;  ///< null means 1 everywhere; not owned
  Sampler sampler{};
};

/// The values of all factors at one point.
template <class R>
using Material = std::array<vec3<R>, kMaterialFactors>;

/// A map that modifies the normal per pixel (shading/surface/surface_detail.h).
struct DetailMap {
  const Texture2D* map = nullptr;  ///< not owned
  Sampler sampler{};
  float strength = 1.0f;    ///< normal map: scale of the x and y components; bump map: height of map value 1, in world units
  bool flip_green = false;  ///< normal map: green points down
  bool difference = false;  ///< bump map: it stores heights, which are differenced within the 2x2 quad; otherwise it stores slopes
  /// Slopes of a displaced sphere: level of detail at which a texel is about as wide as a triangle. 0 for meshes that adapt to the view.
  uint8_t mesh_level = 0;
};

/// Uniforms of a lit surface. Shaders inherit from this struct.
struct LitSurface : SurfaceUniforms {
  LightModel model = LightModel::blinn_phong;
  std::array<Factor, kMaterialFactors> factors;
  DetailMap detail;
  const EnvironmentBlend* reflected_environment = nullptr;  ///< null: none; not owned
  glm::vec3 reflection{0.0f};
  float opacity = 1.0f;  ///< alpha of all fragments

  /// Returns the factors without their maps.
  template <class R>
  HS_INLINE Material<R> constants() const {
    Material<R> m;
    for (std::size_t i = 0; i < kMaterialFactors; ++i) m[i] = vec3<R>(factors[i].constant);
    return m;
  }

  /// Returns the material factors, multiplied by their maps. A map that is shared with the color is sampled only once.
  template <class R>
  HS_INLINE Material<R> material_at(const MapCoordinates<R>& at) const {
    Material<R> m;
    vec3<R> color_texel(R(1));
    for (std::size_t i = 0; i < kMaterialFactors; ++i) {  // a loop, so that the lookup is inlined only once
      const Factor& f = factors[i];
      m[i] = vec3<R>(f.constant);
      if (f.map == nullptr) continue;
      vec3<R> texel = color_texel;
      if (i == kColor || f.map != factors[kColor].map) texel = f.map->sample_rgb(f.sampler, at.uv, at.duv_dx, at.duv_dy);
      if (i == kColor) color_texel = texel;
      m[i] = f.constant * texel;
    }
    return m;
  }

  /// Returns the light that the surface reflects and emits.
  template <class R>
  static HS_INLINE vec3<R> reflected(const Material<R>& m, const Illumination<R>& light) {
    return m[kColor] * (m[kAmbient] + m[kDiffuse] * light.diffuse) + m[kSpecular] * light.specular + m[kEmissive];
  }
};

}  // namespace halfspace::HS_LANES
