// SPDX-License-Identifier: Apache-2.0
//
// Spheres drawn as points. SphereImpostor<false> is the classic trick: a square sized by the centre alone, its circle kept, the
// normal that of a half ball in it, and a depth that is a cone's. What is wrong with it: off the picture's middle a sphere is an
// ellipse and no circle, and two spheres do not meet where they should. SphereImpostor<true> is the sphere: the bounds of
// its ellipse, and a ray by pixel (shading/sphere_intersection.h).
//
// Light, in linear colours:
//   color · (ambient + diffuse · D) + specular · S + emissive       (D and S: shading/lighting.h)
// at the pixel's point of the sphere; the classic sprite takes light and eye as its centre sees them. Shadows fall on the exact one.
#pragma once

#include <span>

#include "halfspace/shading/contract.h"
#include "halfspace/shading/lighting.h"
#include "halfspace/shading/sphere_depth.h"

namespace halfspace {

/// The uniforms of both.
struct SphereImpostors {
  SphereIntersection lens;
  glm::mat3 world_from_camera{1.0f};  ///< its columns: right, up and forward
  glm::vec3 to_eye_ws{0.0f};          ///< orthographic: towards the eye from everywhere; else 0
  float point_scale = 800.0f;         ///< px; of the classic sprite: see point_size
  glm::vec3 ambient{0.0f};            ///< the ambient light is in it
  glm::vec3 diffuse{1.0f}, specular{0.0f}, emissive{0.0f};
  LightModel model = LightModel::phong;
  float shininess = 32.0f;
  std::span<const Light> lights;
};

template <bool exact>
struct SphereImpostor : SphereImpostors {
  template <class R>
  struct Attributes {
    vec3<R> center_cs;
    R radius;
    vec3<R> color;
  };
  template <class R>
  struct Varyings {
    Flat<vec3<R>> center_cs;
    Flat<R> radius;
    Flat<vec3<R>> color;
  };

  template <class R>
  auto vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {{in.center_cs}, {in.radius}, {in.color}};
    if constexpr (exact) {
      return sphere_bounds(lens, in.center_cs, in.radius);
    } else {
      return point(in);
    }
  }

  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    const SphereHit<R> h = hit(in, px);
    return {h.seen, lens.window_depth(h.t, h.t_low)};
  }

  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const SphereHit<R> h = hit(in, px);
    const vec3<R>& c = in.center_cs.value;
    vec3<R> lit_cs = c;
    if constexpr (exact) lit_cs = c + h.n_cs * in.radius.value;
    const vec3<R> position_rws = world_from_camera * lit_cs, n_ws = world_from_camera * h.n_cs;
    const vec3<R> v_ws = lens.perspective ? normalize_or_zero(-position_rws) : vec3<R>(to_eye_ws);
    const Illumination<R> light = illuminate(lights, model, R(shininess), SurfacePoint<R>{position_rws, n_ws, v_ws, n_ws, px.x, px.y});
    const vec3<R> color = in.color.value * (ambient + diffuse * light.diffuse) + specular * light.specular + emissive;
    return {vec4<R>(color, R(1)), h.seen, lens.window_depth(h.t, h.t_low)};
  }

  /// Side of the classic sprite's square, px: point_scale · radius / distance, the distance being that along z times the
  /// tangent of half the width of view (orthographic: half the picture's width).
  template <class R>
  HS_INLINE R point_size(const vec3<R>& center_cs, R radius) const {
    const R size = R(point_scale / lens.half.x) * radius;
    return lens.perspective ? size / max(center_cs.z, R(lens.near)) : size;
  }

 private:
  template <class R>
  HS_INLINE PerVertex<R> point(const Attributes<R>& in) const {
    const vec3<R>& c = in.center_cs;
    const R w = lens.perspective ? c.z : R(1);
    const R z = R(lens.depth_scale) * (R(lens.far) - c.z);
    return {vec4<R>(c.x / R(lens.half.x), c.y / R(lens.half.y), z, w), point_size(c, in.radius), {}};
  }

  // Of the classic sprite: the half ball over the point's circle, as deep as the centre and, in units, the distance from the
  // circle's middle in radii.
  template <class R>
  HS_INLINE SphereHit<R> hit(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec3<R>& c = in.center_cs.value;
    if constexpr (exact) {
      return lens.hit(c, in.radius.value, px.x, px.y);
    } else {
      const vec2<R> coord = px.point_coord();
      const R x = fma(coord.x, R(2), R(-1)), y = -fma(coord.y, R(2), R(-1)), squared = fma(x, x, y * y);
      return {squared <= R(1), c.z + sqrt(squared), R(0), vec3<R>(x, y, -sqrt(max(R(1) - squared, R(0))))};
    }
  }
};

}  // namespace halfspace
