// SPDX-License-Identifier: Apache-2.0
//
// Values of a frame other than its color: depth, normals, positions, ids. Shaders that compute them return one value per attachment.
#pragma once

#include <array>

#include "halfspace/shading/contract.h"

namespace halfspace::HS_LANES {

/// The values, in the order of the attachments that store them.
enum class FrameValue : uint8_t {
  depth,          ///< along the view axis, in scene units (r32f)
  distance,       ///< along the ray of the pixel: from the eye or, in an orthographic view, from its plane (r32f)
  normal,         ///< unit normal that lighting uses, in world space (rgb32f)
  camera_normal,  ///< the same in camera space: x right, y up, z towards the eye (rgb32f)
  albedo,         ///< linear color of the surface before lighting (rgb32f)
  position,       ///< in world space (rgb32f)
  uv,             ///< first set of texture coordinates, not transformed (rg32f)
  object,         ///< r32ui
  instance,       ///< r32ui
  triangle,       ///< r32ui
  barycentrics    ///< weights of the vertices of the triangle, in the order of its indices (rgb32f)
};
inline constexpr std::size_t kFrameValues = 11;

/// Uniforms that are the same for all draws of a frame.
struct FrameCamera {
  glm::vec3 right_ws{1, 0, 0}, up_ws{0, 1, 0}, forward_ws{0, 0, -1};  ///< unit vectors
  glm::vec3 eye_ws{0.0f}, eye_low_ws{0.0f};                           ///< their sum is the position of the eye in double
  bool perspective = true;
};

/// The surface at a fragment, from which the values of all attachments are computed.
template <class R>
struct SurfaceValues {
  vec3<R> position_rws;  ///< relative to the eye, with the axes of world space
  vec3<R> normal_ws;
  vec3<R> albedo;
  vec2<R> uv;
  IntOf<R> object, instance, triangle;
  vec3<R> barycentrics;
};

/// A result of a fragment function, such as TypedFragment, with the types of all attachments.
template <template <class, class...> class Result, class R>
using FrameResult = Result<R, vec4<R>, vec4<R>, vec4<R>, vec4<R>, vec4<R>, vec4<R>, vec4<R>, uvec4<R>, uvec4<R>, uvec4<R>, vec4<R>>;

/// Returns the colors of all attachments.
template <class R>
HS_INLINE FrameResult<TypedColors, R> frame_values(const FrameCamera& camera, const SurfaceValues<R>& v) {
  const R one(1), zero(0);
  const vec3<R>&p = v.position_rws, &n = v.normal_ws;
  const R depth = dot(p, camera.forward_ws), distance = camera.perspective ? length(p) : depth;
  const vec3<R> normal_cs(dot(n, camera.right_ws), dot(n, camera.up_ws), -dot(n, camera.forward_ws));
  const auto number = [](IntOf<R> i) { return uvec4<R>(UintOf<R>(i), UintOf<R>(0u), UintOf<R>(0u), UintOf<R>(0u)); };
  return {vec4<R>(depth, zero, zero, one),
          vec4<R>(distance, zero, zero, one),
          vec4<R>(n, one),
          vec4<R>(normal_cs, one),
          vec4<R>(v.albedo, one),
          vec4<R>((p + camera.eye_low_ws) + camera.eye_ws, one),
          vec4<R>(v.uv, zero, one),
          number(v.object),
          number(v.instance),
          number(v.triangle),
          vec4<R>(v.barycentrics, one)};
}

}  // namespace halfspace::HS_LANES
