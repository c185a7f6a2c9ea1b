// SPDX-License-Identifier: Apache-2.0
//
// Computes the values of shading/values/frame_values.h for meshes, points and lines. One shader serves all surface shaders of a scene: it
// has every attribute that any of them has. Streams that a mesh lacks are bound to a constant row.
#pragma once

#include "halfspace/shading/surface/metallic_surface.h"
#include "halfspace/shading/surface/surface_detail.h"
#include "halfspace/shading/surface/surface_shader.h"
#include "halfspace/shading/values/frame_values.h"

namespace halfspace::HS_LANES {

/// Uniforms of a surface. Its normal is the one that its own shader uses for lighting.
struct SurfaceValueUniforms : SurfaceUniforms {
  FrameCamera camera{};
  int32_t object = 0, instance = 0;
  bool wants_albedo = true, wants_normal = true;  ///< otherwise the maps are not sampled, and the value is unspecified
  bool face_normal = false;                       ///< use the normal of the triangle instead of those of its vertices
  NormalDetail normal_detail = NormalDetail::none;
  DetailMap detail{};
  MaterialMap detail_coordinates{};  ///< texture coordinates of the detail; only uv_set and uv_transform are used
  glm::vec4 color{1.0f};             ///< linear; multiplied by the vertex colors and color_map; w is the opacity
  MaterialMap color_map{};           ///< its alpha multiplies the opacity
  MaterialMap opacity_map{};         ///< its channel multiplies the opacity
  float opacity_cutoff = 0.5f;       ///< masked surfaces are discarded below it
};

/// masked: pixels whose opacity is below opacity_cutoff are discarded, as in MetallicSurface.
template <bool masked>
struct SurfaceValueShader : SurfaceValueUniforms {
  template <class R>
  struct Attributes {
    vec3<R> position_os, normal_os;
    vec4<R> tangent_os;  ///< w is the sign of the bitangent
    vec2<R> uv, second_uv;
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    vec3<R> position_os, position_rws, normal_ws, tangent_ws;
    Flat<R> side;
    vec2<R> uv, second_uv;
    vec4<R> color;
  };
  template <class R>
  using Result = std::conditional_t<masked, FrameResult<DiscardingTypedFragment, R>, FrameResult<TypedFragment, R>>;

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position_os = in.position_os;
    out.position_rws = position_rws(in.position_os);
    out.normal_ws = normalize_or_zero(normal_from_object * in.normal_os);
    out.tangent_ws = normalize_or_zero(glm::mat3(world_from_object) * vec3<R>(in.tangent_os));
    out.side = {in.tangent_os.w * R(handedness)};
    out.uv = in.uv;
    out.second_uv = in.second_uv;
    out.color = in.color;
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }

  template <class R>
  Result<R> fragment(const Varyings<R>& in, const PrimitiveId<R>& id, const Pixel<R>& px) const {
    vec4<R> base = color * in.color;
    if (masked || wants_albedo) base = base * texel_at(in, px);
    const vec3<R> normal_ws = wants_normal ? normal_at(in, px) : vec3<R>(R(0));
    Result<R> out;
    out.color = frame_values<R>(camera, {in.position_rws, normal_ws, vec3<R>(base), in.uv, IntOf<R>(object), id.instance + instance,
                                         id.primitive, id.barycentrics});
    if constexpr (masked) out.keep = base.w >= R(opacity_cutoff);
    return out;
  }

 private:
  template <class R>
  static HS_INLINE MapCoordinates<R> map_coordinates(const MaterialMap& m, const Varyings<R>& in, const Pixel<R>& px) {
    using V = Varyings<R>;
    if (m.uv_set == 1) return transformed(m.uv_transform, MapCoordinates<R>{in.second_uv, px.ddx(&V::second_uv), px.ddy(&V::second_uv)});
    return transformed(m.uv_transform, MapCoordinates<R>{in.uv, px.ddx(&V::uv), px.ddy(&V::uv)});
  }

  /// Returns the color and opacity of the maps.
  template <class R>
  HS_INLINE vec4<R> texel_at(const Varyings<R>& in, const Pixel<R>& px) const {
    vec4<R> texel(R(1)), out(R(1));
    for (const MaterialMap* m : {&color_map, &opacity_map}) {  // a loop, so that the lookup is inlined only once
      if (m->map == nullptr) continue;
      if (!m->repeats) {
        const MapCoordinates<R> at = map_coordinates(*m, in, px);
        texel = m->map->sample(m->sampler, at.uv, at.duv_dx, at.duv_dy);
      }
      if (m == &color_map) {
        out = texel;
      } else {
        out.w *= dot(texel, vec4<R>(m->channel));
      }
    }
    return out;
  }

  template <class R>
  HS_INLINE vec3<R> normal_at(const Varyings<R>& in, const Pixel<R>& px) const {
    using V = Varyings<R>;
    if (face_normal) return face_towards(cross(px.ddx(&V::position_rws), px.ddy(&V::position_rws)), to_eye(in.position_rws));
    const vec3<R> n = normalize_or_zero(detailed_normal(in, px));
    return two_sided ? n * select(px.front_facing, R(1), R(-1)) : n;
  }

  template <class R>
  HS_INLINE vec3<R> detailed_normal(const Varyings<R>& in, const Pixel<R>& px) const {
    using V = Varyings<R>;
    if (normal_detail == NormalDetail::none) return in.normal_ws;
    const MapCoordinates<R> at = map_coordinates(detail_coordinates, in, px);
    if (normal_detail == NormalDetail::map) return normal_from_map(detail, at, in.normal_ws, in.tangent_ws, in.side.value);
    if (normal_detail == NormalDetail::slopes) {
      const vec3<R> slope = detail.map->sample_rgb(detail.sampler, at.uv, at.duv_dx, at.duv_dy);
      return normal_from_object * normal_from_slopes(normalize_or_zero(in.position_os), slope);
    }
    const HeightSteps<R> steps =
        detail.difference ? height_differences<V>(detail, px, at, [](const V& v) { return v.uv; }) : height_steps(detail, at);
    return normal_from_heights(normalize_or_zero(in.normal_ws), steps, px.ddx(&V::position_rws), px.ddy(&V::position_rws));
  }
};

}  // namespace halfspace::HS_LANES
