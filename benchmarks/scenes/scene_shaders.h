// SPDX-License-Identifier: Apache-2.0
//
// Shaders of the scenes. peers/gl/gl_scene_glsl.h has the same formulas in GLSL.
#pragma once

#include "halfspace/shading/contract.h"
#include "scenes/scene.h"
#include "workloads/workload_shadow.h"

namespace halfspace {

/// Base class of the main pass's shaders.
struct SceneUniforms {
  glm::mat4 world_from_object, clip_from_world, light_from_world;
  glm::vec3 eye_ws;
  WorkloadShadowMap shadow_map;
  const SceneLighting* light;
  const Texture2D* map;
  glm::vec3 tint;
  float gloss, alpha;

  template <class R>
  struct Attributes {
    vec3<R> position_os, normal_os;
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec3<R> position_ws, normal_ws;
    vec2<R> uv;
  };

  template <class R>
  HS_INLINE vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const vec4<R> position = world_from_object * vec4<R>(in.position_os, R(1));
    out.position_ws = vec3<R>(position);
    out.normal_ws = vec3<R>(world_from_object * vec4<R>(in.normal_os, R(0)));
    out.uv = in.uv;
    return clip_from_world * position;
  }
  template <class R>
  HS_INLINE vec4<R> texel(const Varyings<R>& in, const Pixel<R>& px) const {
    return map->sample(Sampler{}, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv));
  }
  template <class R>
  HS_INLINE vec3<R> texel_rgb(const Varyings<R>& in, const Pixel<R>& px) const {
    return map->sample_rgb(Sampler{}, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv));
  }

  /// Mixes a color with the haze between the eye and the surface. d2: squared distance of the surface.
  template <class R>
  HS_INLINE vec3<R> through_haze(const vec3<R>& color, R d2) const {
    const R share = d2 / (d2 + R(light->haze_distance * light->haze_distance));
    return color + (vec3<R>(light->haze) - color) * share;
  }

  /// Computes the light of the sun, the sky, the ground and the lamp on a surface.
  template <class R>
  HS_INLINE vec3<R> shade(const vec3<R>& base, const Varyings<R>& in) const {
    const vec3<R> n = unit(in.normal_ws), to_eye = eye_ws - in.position_ws, to_lamp = light->lamp_ws - in.position_ws;
    const R d2 = dot(to_eye, to_eye);
    const WorkloadLight<R> sun = blinn_phong(n, vec3<R>(light->to_sun), to_eye * inverse_sqrt(d2));
    const R seen = unoccluded_fraction(shadow_map, light_from_world, kSceneBias, in.position_ws + n * R(kSceneNormalOffset));
    const R lamp = max(dot(n, to_lamp), R(0)) / (R(1) + dot(to_lamp, to_lamp));
    const vec3<R> ambient = vec3<R>(light->ground) + vec3<R>(light->sky - light->ground) * (R(0.5f) + R(0.5f) * n.y);
    const vec3<R> diffuse = ambient + vec3<R>(light->sun) * (seen * sun.diffuse) + vec3<R>(light->lamp) * lamp;
    return through_haze(vec3<R>(base * diffuse + vec3<R>(light->sun) * (seen * sun.specular * R(gloss))), d2);
  }
};

struct SceneOpaque : SceneUniforms {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(shade(texel_rgb(in, px) * vec3<R>(tint), in), R(1))};
  }
};

struct SceneCutout : SceneUniforms {
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec4<R> color = texel(in, px);
    return {vec4<R>(shade(vec3<R>(color) * vec3<R>(tint), in), R(1)), color.w >= R(0.5f)};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    return {map->sample_alpha(Sampler{}, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv)) >= R(0.5f), px.z()};
  }
};

/// Glass and water: opaque at grazing angles, where they reflect the sky.
struct SceneBlended : SceneUniforms {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec4<R> color = texel(in, px);
    const vec3<R> to_eye = unit(eye_ws - in.position_ws);
    const R facing = R(1) - abs(dot(unit(in.normal_ws), to_eye)), facing2 = facing * facing, mirrored = facing2 * facing2;
    const vec3<R> body = shade(vec3<R>(color) * vec3<R>(tint), in);
    const R opacity = color.w * R(alpha);
    return {vec4<R>(body + (vec3<R>(light->haze) - body) * mirrored, opacity + (R(1) - opacity) * mirrored)};
  }
};

struct SceneUnlit : SceneUniforms {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(texel_rgb(in, px) * vec3<R>(tint), R(1))};
  }
};

/// Depth-only shader for surfaces with holes.
struct SceneCutoutDepth {
  glm::mat4 clip_from_object;
  const Texture2D* map;

  template <class R>
  struct Attributes {
    vec3<R> position_os;
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv;
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    return {map->sample_alpha(Sampler{}, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv)) >= R(0.5f), px.z()};
  }
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(R(0)), visibility(in, px).keep};
  }
};

}  // namespace halfspace
