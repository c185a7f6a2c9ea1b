// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/lighting.h"
#include "shading/pixel.h"

namespace halfspace {

/// The unit normal of the triangle that a pixel shows, on the side of the eye, from the derivatives of a position varying
/// in the world's axes. v_ws points towards the eye. Zero where the triangle is seen edge-on.
template <class V, class R>
HS_INLINE vec3<R> face_normal(const Pixel<R>& px, vec3<R> V::*position, const vec3<R>& v_ws) {
  const vec3<R> n = normalize_or_zero(cross(px.ddx(position), px.ddy(position)));
  return n * select(dot(n, v_ws) >= R(0), R(1), R(-1));
}

}  // namespace halfspace
