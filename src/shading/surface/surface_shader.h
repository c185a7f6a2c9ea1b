// SPDX-License-Identifier: Apache-2.0
//
// The shader for surfaces. The shading rate, a template parameter, determines how often lighting (shading/light/lighting.h) is computed.
// Maps are sampled per pixel at every rate. Each variant has only the attributes and varyings that it needs.
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/environment/reflection.h"
#include "halfspace/shading/shadow/terminator.h"
#include "halfspace/shading/surface/surface_detail.h"

namespace halfspace::HS_LANES {

/// The source of per-pixel normal detail (shading/surface/surface_detail.h). Only ShadingRate::phong supports it.
enum class NormalDetail : uint8_t {
  none,
  map,    ///< LitSurface::detail is a normal map, and vertices have tangents
  bump,   ///< LitSurface::detail is a bump map
  slopes  ///< LitSurface::detail stores the slopes of a displaced sphere; the vertex positions are along its normals
};

/// mapped: the draw call has texture coordinates and may have maps; otherwise all maps are null. highlight: the material has specular
/// light. Without a highlight, the varying for it is omitted; only gouraud with maps supports this.
template <ShadingRate rate, bool mapped, NormalDetail normal_detail = NormalDetail::none, bool highlight = true>
struct SurfaceShader : LitSurface {
  static_assert(normal_detail == NormalDetail::none || (rate == ShadingRate::phong && mapped),
                "normal and bump maps need the shading rate phong and texture coordinates");
  static_assert(highlight || (rate == ShadingRate::gouraud && mapped), "only the shading rate gouraud with maps can omit the highlight");
  static constexpr bool kByVertex = rate == ShadingRate::provoking || rate == ShadingRate::gouraud;
  static constexpr bool kByPixel = rate == ShadingRate::phong;
  static constexpr bool kSlopes = normal_detail == NormalDetail::slopes;
  static constexpr bool kNormals = kByVertex || (kByPixel && !kSlopes);
  static constexpr bool kTangents = normal_detail == NormalDetail::map;
  static constexpr bool kMapped = mapped;

  template <class R>
  struct Attributes {
    vec3<R> position_os;
    [[no_unique_address]] MemberIf<kNormals, vec3<R>, 0> normal_os;
    [[no_unique_address]] MemberIf<kTangents, vec4<R>, 1> tangent_os;  ///< w is the sign of the bitangent
    [[no_unique_address]] MemberIf<mapped, vec2<R>, 2> uv;
  };

  // Light computed per vertex: the final color if there are no maps, otherwise the light that the maps are applied to.
  template <class T>
  using PerVertex = std::conditional_t<rate == ShadingRate::provoking, Flat<T>, T>;

  template <class R>
  struct Varyings {
    [[no_unique_address]] MemberIf<rate == ShadingRate::flat, Flat<vec3<R>>, 0> corner_rws;  ///< only for the primitive function
    [[no_unique_address]] MemberIf<kSlopes, vec3<R>, 1> position_os;
    [[no_unique_address]] MemberIf<kByPixel && !kSlopes, vec3<R>, 2> position_rws;
    [[no_unique_address]] MemberIf<kByPixel && !kSlopes, vec3<R>, 3> normal_ws;
    [[no_unique_address]] MemberIf<kTangents, vec3<R>, 4> tangent_ws;
    [[no_unique_address]] MemberIf<kTangents, Flat<R>, 5> side;
    [[no_unique_address]] MemberIf<kByVertex && !mapped, PerVertex<vec3<R>>, 6> color;
    [[no_unique_address]] MemberIf<kByVertex && mapped, PerVertex<vec3<R>>, 7> diffuse;
    [[no_unique_address]] MemberIf<kByVertex && mapped && highlight, PerVertex<vec3<R>>, 8> specular;
    [[no_unique_address]] MemberIf<mapped, vec2<R>, 9> uv;
  };

  template <class R>
  requires(rate == ShadingRate::flat) struct Primitive {
    [[no_unique_address]] MemberIf<!mapped, vec3<R>, 0> color;
    [[no_unique_address]] MemberIf<mapped, vec3<R>, 1> diffuse;
    [[no_unique_address]] MemberIf<mapped, vec3<R>, 2> specular;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    if constexpr (mapped) out.uv = in.uv;
    if constexpr (rate == ShadingRate::flat) out.corner_rws.value = position_rws(in.position_os);
    if constexpr (kSlopes) out.position_os = in.position_os;
    if constexpr (kNormals) {
      const vec3<R> normal_ws = normalize_or_zero(normal_from_object * in.normal_os);
      if constexpr (kByVertex) {
        store_light(out, point_towards_eye(position_rws(in.position_os), normal_ws));
      } else {
        out.position_rws = position_rws(in.position_os);
        out.normal_ws = normal_ws;
      }
    }
    if constexpr (kTangents) {
      out.tangent_ws = normalize_or_zero(vec3<R>(world_from_object * vec4<R>(vec3<R>(in.tangent_os), R(0))));
      out.side.value = in.tangent_os.w * R(handedness);
    }
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }

  template <class R>
  requires(rate == ShadingRate::flat) Primitive<R> primitive(const Varyings<R>& v0, const Varyings<R>& v1, const Varyings<R>& v2)
  const {
    const vec3<R>&a = v0.corner_rws.value, &b = v1.corner_rws.value, &c = v2.corner_rws.value;
    const vec3<R> normal_ws = cross(b - a, c - a) * handedness;
    Primitive<R> face;
    store_light(face, point_towards_eye((a + b + c) * (1.0f / 3.0f), normalize_or_zero(normal_ws)));
    return face;
  }

  template <class R>
  requires(rate == ShadingRate::flat) Fragment<R> fragment(const Varyings<R>& in, const Primitive<R>& face, const Pixel<R>& px)
  const { return {vec4<R>(with_light_of(face, in, px), R(opacity))}; }

  template <class R>
  requires(rate != ShadingRate::flat) Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px)
  const {
    if constexpr (kByVertex) {
      return {vec4<R>(with_light_of(in, in, px), R(opacity))};
    } else if constexpr (rate == ShadingRate::none) {
      const Material<R> m = material(in, px);
      return {vec4<R>(m[kColor] + m[kEmissive], R(opacity))};
    } else {
      const Material<R> m = material(in, px);
      const SurfacePoint<R> p = point_at(in, px);
      vec3<R> light = reflected(m, illuminate(lights.at_pixel(px.x, px.y), model, m[kShininess].x, p));
      if (reflected_environment != nullptr)
        light += reflection * environment_reflection(*reflected_environment, from_eye(in, px), normal_with_steps(in, px, p.n_ws));
      return {vec4<R>(light, R(opacity))};
    }
  }

 private:
  template <class T>
  static HS_INLINE const T& plain(const T& value) {
    return value;
  }
  template <class T>
  static HS_INLINE const T& plain(const Flat<T>& flat) {
    return flat.value;
  }

  /// Returns a surface point for cases where the visible side has to be determined from the normal.
  template <class R>
  HS_INLINE SurfacePoint<R> point_towards_eye(const vec3<R>& position_rws, const vec3<R>& n_ws) const {
    const vec3<R> v_ws = to_eye(position_rws);
    const R side = two_sided ? select(dot(n_ws, v_ws) < R(0), R(-1), R(1)) : R(1);
    return {position_rws, n_ws * side, v_ws, n_ws * side};
  }

  template <class R, class To>
  HS_INLINE void store_light(To& to, const SurfacePoint<R>& p) const {
    const Illumination<R> light = illuminate(lights, model, R(factors[kShininess].constant.x), p);
    if constexpr (mapped) {
      to.diffuse = {light.diffuse};
      if constexpr (highlight) to.specular = {light.specular};
    } else {
      to.color = {reflected(constants<R>(), light)};
    }
  }

  template <class R, class From>
  HS_INLINE vec3<R> with_light_of(const From& from, const Varyings<R>& in, const Pixel<R>& px) const {
    if constexpr (mapped && highlight) {
      return reflected(material(in, px), Illumination<R>{plain(from.diffuse), plain(from.specular)});
    } else if constexpr (mapped) {
      return reflected(material(in, px), Illumination<R>{plain(from.diffuse), vec3<R>(R(0))});
    } else {
      return plain(from.color);
    }
  }

  template <class R>
  static HS_INLINE MapCoordinates<R> map_coordinates(const Varyings<R>& in, const Pixel<R>& px) {
    return {in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv)};
  }

  template <class R>
  HS_INLINE Material<R> material(const Varyings<R>& in, const Pixel<R>& px) const {
    if constexpr (mapped) {
      return material_at(map_coordinates(in, px));
    } else {
      return constants<R>();
    }
  }

  template <class R>
  HS_INLINE SurfacePoint<R> point_at(const Varyings<R>& in, const Pixel<R>& px) const {
    vec3<R> position;
    if constexpr (kSlopes) {
      position = position_rws(in.position_os);
    } else {
      position = in.position_rws;
    }
    const vec3<R> n_ws = normalize_or_zero(detailed_normal(in, px));
    const vec3<R> lit_ws = two_sided ? n_ws * select(px.front_facing, R(1), R(-1)) : n_ws;
    SurfacePoint<R> p{position, lit_ws, to_eye(position), lit_ws, px.x, px.y};
    if (shadowed) {
      p.face_ws = face_normal(px, p.v_ws);
      set_smooth_surface(in, px, p);
    }
    return p;
  }

  /// Sets the smooth surface above the triangle. The vertices of a displaced sphere have no normals. Instead, its normals are those of the
  /// slope map, filtered to the size of a triangle (not filtered if the mesh adapts to the view), and its height is 0, because its
  /// triangles are small.
  template <class R>
  HS_INLINE void set_smooth_surface(const Varyings<R>& in, const Pixel<R>& px, SurfacePoint<R>& p) const {
    using V = Varyings<R>;
    const R side = two_sided ? select(px.front_facing, R(1), R(-1)) : R(1);
    if constexpr (kSlopes) {
      const vec3<R> slope(detail.map->template sample_level<R>(detail.sampler, in.uv, R(static_cast<float>(detail.mesh_level))));
      p.smooth_ws = normalize_or_zero(normal_from_object * normal_from_slopes(normalize_or_zero(in.position_os), slope)) * side;
    } else {
      if constexpr (normal_detail != NormalDetail::none) p.smooth_ws = normalize_or_zero(in.normal_ws) * side;
      p.smooth_height = smooth_height(in.normal_ws, px.ddx(&V::normal_ws) * side, px.ddy(&V::normal_ws) * side, px.ddx(&V::position_rws),
                                      px.ddy(&V::position_rws));
    }
  }

  /// Returns the unit normal of the triangle on the side of the eye, or zero if it is seen edge-on.
  template <class R>
  HS_INLINE vec3<R> face_normal(const Pixel<R>& px, const vec3<R>& v_ws) const {
    using V = Varyings<R>;
    if constexpr (kSlopes) {
      return face_towards(normal_from_object * cross(px.ddx(&V::position_os), px.ddy(&V::position_os)), v_ws);
    } else {
      return face_towards(cross(px.ddx(&V::position_rws), px.ddy(&V::position_rws)), v_ws);
    }
  }

  template <class R>
  HS_INLINE vec3<R> detailed_normal(const Varyings<R>& in, const Pixel<R>& px) const {
    using V = Varyings<R>;
    if constexpr (normal_detail == NormalDetail::none) {
      return in.normal_ws;
    } else if constexpr (normal_detail == NormalDetail::map) {
      return normal_from_map(detail, map_coordinates(in, px), in.normal_ws, in.tangent_ws, in.side.value);
    } else if constexpr (normal_detail == NormalDetail::bump) {
      const MapCoordinates<R> at = map_coordinates(in, px);
      const HeightSteps<R> steps =
          detail.difference ? height_differences<V>(detail, px, at, [](const V& v) { return v.uv; }) : height_steps(detail, at);
      return normal_from_heights(normalize_or_zero(in.normal_ws), steps, px.ddx(&V::position_rws), px.ddy(&V::position_rws));
    } else {
      const MapCoordinates<R> at = map_coordinates(in, px);
      const vec3<R> slope = detail.map->sample_rgb(detail.sampler, at.uv, at.duv_dx, at.duv_dy);
      return normal_from_object * normal_from_slopes(normalize_or_zero(in.position_os), slope);
    }
  }

  /// Returns the vector from the eye to the surface point of the pixel, with its derivatives.
  template <class R>
  HS_INLINE Differential<R> from_eye(const Varyings<R>& in, const Pixel<R>& px) const {
    using V = Varyings<R>;
    if (to_eye_ws != glm::vec3(0.0f)) return {vec3<R>(-to_eye_ws), vec3<R>(R(0)), vec3<R>(R(0))};
    if constexpr (kSlopes) {
      const glm::mat3 turn(world_from_object);
      return {position_rws(in.position_os), turn * px.ddx(&V::position_os), turn * px.ddy(&V::position_os)};
    } else {
      return {in.position_rws, px.ddx(&V::position_rws), px.ddy(&V::position_rws)};
    }
  }

  /// Returns n_ws with the derivatives of the surface normal. Changes of the normal that come from maps are not taken into account.
  template <class R>
  HS_INLINE Differential<R> normal_with_steps(const Varyings<R>& in, const Pixel<R>& px, const vec3<R>& n_ws) const {
    using V = Varyings<R>;
    Differential<R> n;
    if constexpr (kSlopes) {
      const glm::mat3& turn = normal_from_object;
      n = normalized<R>({turn * in.position_os, turn * px.ddx(&V::position_os), turn * px.ddy(&V::position_os)});
    } else {
      n = normalized<R>({in.normal_ws, px.ddx(&V::normal_ws), px.ddy(&V::normal_ws)});
    }
    const R side = two_sided ? select(px.front_facing, R(1), R(-1)) : R(1);
    return {n_ws, n.dx * side, n.dy * side};
  }
};

}  // namespace halfspace::HS_LANES
