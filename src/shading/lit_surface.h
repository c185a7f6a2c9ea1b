// SPDX-License-Identifier: Apache-2.0
//
// What the shaders of lit surfaces have in common: where the surface stands, what it looks like, what light falls on it.
//
//   colour = color · (ambient + diffuse · D) + specular · S + emissive + reflection · M
//
// with D and S the diffuse and specular light of shading/lighting.h, M the light of the surroundings that the surface mirrors
// (shading/reflection.h; by pixel alone). Each factor but reflection is a constant times a map where there is one.
#pragma once

#include <array>

#include "halfspace/shading/environment.h"
#include "halfspace/shading/lighting.h"
#include "halfspace/shading/texture.h"

namespace halfspace {

/// The factors of a surface's answer to light.
enum MaterialFactor : uint8_t { kColor, kAmbient, kDiffuse, kSpecular, kEmissive, kShininess };
inline constexpr std::size_t kMaterialFactors = 6;

/// A factor: linear, of kShininess the first component.
struct Factor {
  glm::vec3 constant{1.0f};
  const Texture2D* map = nullptr;  ///< null: 1 everywhere; not owned
  Sampler sampler{};
};

/// All factors at one place.
template <class R>
using Material = std::array<vec3<R>, kMaterialFactors>;

/// A place on a surface's maps, for a pixel whose steps to the right and up change uv by duv_dx and duv_dy.
template <class R>
struct MapCoordinates {
  vec2<R> uv, duv_dx, duv_dy;
};

/// What tells a pixel's normal beyond those of the vertices; shading/surface_detail.h.
struct DetailMap {
  const Texture2D* map = nullptr;  ///< not owned
  Sampler sampler{};
  float strength = 1.0f;    ///< of a normal map's tilt; of a bump map the height of 1, in the world's unit
  bool flip_green = false;  ///< of a normal map: green is down
  bool difference = false;  ///< of a bump map: it holds heights, to be subtracted in the 2x2 quad; else slopes
};

/// Uniforms, to be inherited by a shader.
struct LitSurface {
  glm::mat4 clip_from_object;
  glm::mat4 world_from_object;    ///< to the world's axes round the eye (_rws, see Light)
  glm::mat3 normal_from_object;   ///< inverse transpose of world_from_object's upper left 3x3
  float handedness = 1.0f;        ///< −1 where world_from_object mirrors
  glm::vec3 to_eye_ws{0.0f};      ///< unit vector towards the eye where that is the same everywhere (orthographic); else 0
  std::span<const Light> lights;  ///< not owned
  bool shadowed = false;          ///< one of them at least has a shadow
  LightModel model = LightModel::blinn_phong;
  bool two_sided = false;  ///< a back face is lit by the turned normal
  std::array<Factor, kMaterialFactors> factors;
  DetailMap detail;
  const EnvironmentBlend* surroundings = nullptr;  ///< what is mirrored; null: nothing; not owned
  glm::vec3 reflection{0.0f};

  template <class R>
  HS_INLINE vec3<R> position_rws(const vec3<R>& position_os) const {
    return vec3<R>(world_from_object * vec4<R>(position_os, R(1)));
  }

  template <class R>
  HS_INLINE vec3<R> to_eye(const vec3<R>& position_rws) const {
    return to_eye_ws == glm::vec3(0.0f) ? normalize_or_zero(-position_rws) : vec3<R>(to_eye_ws);
  }

  /// The factors without their maps.
  template <class R>
  HS_INLINE Material<R> constants() const {
    Material<R> m;
    for (std::size_t i = 0; i < kMaterialFactors; ++i) m[i] = vec3<R>(factors[i].constant);
    return m;
  }

  /// The factors with their maps. A map that is the colour's own is not read again.
  template <class R>
  HS_INLINE Material<R> material_at(const MapCoordinates<R>& place) const {
    Material<R> m;
    vec3<R> color_texel(R(1));
    for (std::size_t i = 0; i < kMaterialFactors; ++i) {  // a loop, for one copy of the look-up
      const Factor& f = factors[i];
      m[i] = vec3<R>(f.constant);
      if (f.map == nullptr) continue;
      vec3<R> texel = color_texel;
      if (i == kColor || f.map != factors[kColor].map) texel = f.map->sample_rgb(f.sampler, place.uv, place.duv_dx, place.duv_dy);
      if (i == kColor) color_texel = texel;
      m[i] = f.constant * texel;
    }
    return m;
  }

  /// Light as the surface sends it back.
  template <class R>
  static HS_INLINE vec3<R> reflected(const Material<R>& m, const Illumination<R>& light) {
    return m[kColor] * (m[kAmbient] + m[kDiffuse] * light.diffuse) + m[kSpecular] * light.specular + m[kEmissive];
  }
};

}  // namespace halfspace
