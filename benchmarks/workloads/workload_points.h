// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/shading/contract.h"
#include "workloads/workload_shading.h"

namespace halfspace {

/// Point sprites shaded as spheres. The fragment function computes the normal and depth of the sphere. Eye space is world space translated
/// to the eye, without a rotation.
struct PointShader {
  glm::mat4 clip_from_world;
  glm::vec3 eye_ws;
  glm::vec2 half_size;     ///< half the image size in pixels
  float size_at_w1;        ///< diameter of a sphere in pixels where clip-space w is 1
  float depth_a, depth_b;  ///< clip-space z is depth_a·z + depth_b for an eye-space z
  float radius;
  glm::vec3 light_es{2.0f, 3.0f, 4.0f};

  template <class R>
  struct Attributes {
    vec3<R> position_ws;
  };
  template <class R>
  struct Varyings {
    Flat<vec3<R>> center_es, base;
    Flat<vec3<R>> disk;  ///< center of the disk in window coordinates and 1/radius, in pixels
  };

  template <class R>
  PerVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.center_es.value = in.position_ws - eye_ws;
    out.base.value = glm::vec3(0.5f) + in.position_ws * 0.5f;
    const vec4<R> clip = clip_from_world * vec4<R>(in.position_ws, R(1));
    const R inverse = R(1) / clip.w, size = R(size_at_w1) * inverse;
    const R half_width(half_size.x), half_height(half_size.y);
    out.disk.value = {fma(clip.x * inverse, half_width, half_width), fma(clip.y * inverse, half_height, half_height), R(2) / size};
    return {clip, size, {}};
  }
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const Bump<R> bump = bump_at(in, px);
    const vec4<R> color = lit(in.base.value, phong(bump.n, unit(light_es - bump.position_es), unit(-bump.position_es)));
    return {color, bump.inside, depth_of(bump)};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    const Bump<R> bump = bump_at(in, px);
    return {bump.inside, depth_of(bump)};
  }

 private:
  // The point of the sphere that is visible at a pixel, assuming that all view rays are parallel (an approximation).
  template <class R>
  struct Bump {
    vec3<R> n, position_es;
    MaskOf<R> inside;
  };
  template <class R>
  HS_INLINE Bump<R> bump_at(const Varyings<R>& in, const Pixel<R>& px) const {
    // Computes 2·coord − 1 with y up, from the definition of the point coordinate (OpenGL 4.6, section 14.4.1). px.point_coord() is
    // relative to the center snapped to 1/256 px, which is too coarse for points as small as these.
    const vec3<R>& disk = in.disk.value;
    const R dx = (px.x - disk.x) * disk.z, dy = (px.y - disk.y) * disk.z, squared = dx * dx + dy * dy;
    const vec3<R> n(dx, dy, sqrt(max(R(1) - squared, R(0))));
    return {n, in.center_es.value + n * radius, squared <= R(1)};
  }
  template <class R>
  HS_INLINE R depth_of(const Bump<R>& bump) const {
    const R z = bump.position_es.z;
    return R(0.5f) - R(0.5f) * ((R(depth_a) * z + R(depth_b)) / z);
  }
};

}  // namespace halfspace
