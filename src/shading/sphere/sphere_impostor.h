// SPDX-License-Identifier: Apache-2.0
//
// Spheres drawn as points. SphereImpostor<false> is the classic approximation: a square whose size depends only on the center, cut
// to a circle, with the normals of a hemisphere and the depth of a cone. It is wrong in two ways: away from the image center a
// sphere appears as an ellipse, not a circle, and intersections of spheres are in the wrong place. SphereImpostor<true> is exact: it
// covers the bounds of the ellipse and intersects a ray with the sphere per pixel (shading/sphere/sphere_intersection.h).
//
// The linear color is
//   color · (ambient + diffuse · D) + specular · S + emissive       (D and S: shading/light/lighting.h)
// at the point of the sphere that is visible in the pixel. The classic sprite uses the light and view vectors of its center. Only exact
// spheres receive shadows.
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/light/lighting.h"
#include "halfspace/shading/sphere/sphere_depth.h"

namespace halfspace::HS_LANES {

/// Uniforms of both variants.
struct SphereImpostors {
  SphereIntersection lens;
  glm::mat3 world_from_camera{1.0f};  ///< columns are right, up and forward
  glm::vec3 to_eye_ws{0.0f};          ///< orthographic: constant unit vector towards the eye; perspective: 0
  float point_scale = 800.0f;         ///< pixels; size of classic sprites, see point_size
  glm::vec3 ambient{0.0f};            ///< includes the ambient light
  glm::vec3 diffuse{1.0f}, specular{0.0f}, emissive{0.0f};
  LightModel model = LightModel::phong;
  float shininess = 32.0f;
  LightSet lights;
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
    const Illumination<R> light =
        illuminate(lights.at_pixel(px.x, px.y), model, R(shininess), SurfacePoint<R>{position_rws, n_ws, v_ws, n_ws, px.x, px.y});
    const vec3<R> color = in.color.value * (ambient + diffuse * light.diffuse) + specular * light.specular + emissive;
    return {vec4<R>(color, R(1)), h.seen, lens.window_depth(h.t, h.t_low)};
  }

  /// Returns the side length of the sprite in pixels: point_scale · radius / half_width, where half_width is half the width of the view
  /// volume at depth z.
  template <class R>
  HS_INLINE R point_size(const vec3<R>& center_cs, R radius) const {
    const R size = R(point_scale / lens.half.x) * radius;
    return lens.perspective ? size / max(center_cs.z, R(lens.near)) : size;
  }

 protected:
  template <class R>
  HS_INLINE PerVertex<R> point(const Attributes<R>& in) const {
    const vec3<R>& c = in.center_cs;
    const R w = lens.perspective ? c.z : R(1);
    const R z = R(lens.depth_scale) * (R(lens.far) - c.z);
    return {vec4<R>(c.x / R(lens.half.x), c.y / R(lens.half.y), z, w), point_size(c, in.radius), {}};
  }

  // For the classic sprite: a hemisphere over the circle of the point. The depth is the depth of the center plus the distance from the
  // middle of the circle, where one radius counts as one world unit.
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

}  // namespace halfspace::HS_LANES
