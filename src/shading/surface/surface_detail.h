// SPDX-License-Identifier: Apache-2.0
//
// Per-pixel normals from a normal map, a bump map, or the slopes of a displaced sphere. Results are not normalized. Where a map has
// no detail, they equal the input normal.
#pragma once

#include "halfspace/shading/pixel.h"
#include "halfspace/shading/surface/lit_surface.h"

namespace halfspace::HS_LANES {

/// Applies a tangent-space normal map. x is along the tangent and y along the bitangent, which points up in the image of the map;
/// components are encoded as 2c − 1 (as in glTF 2.0). n_ws and tangent_ws are the interpolated vectors, not renormalized
/// (the convention of M. Mikkelsen's MikkTSpace, which baking tools follow). `side` is ±1 and includes mirroring.
template <class R>
HS_INLINE vec3<R> normal_from_map(const DetailMap& detail, const MapCoordinates<R>& at, const vec3<R>& n_ws, const vec3<R>& tangent_ws,
                                  R side) {
  const vec3<R> code = detail.map->sample_rgb(detail.sampler, at.uv, at.duv_dx, at.duv_dy);
  const R tilt(2.0f * detail.strength), up(detail.flip_green ? -2.0f * detail.strength : 2.0f * detail.strength);
  const R x = (code.x - R(0.5f)) * tilt, y = (code.y - R(0.5f)) * up, z = max(R(2) * code.z - R(1), R(0));
  const vec3<R> n = tangent_ws * x + cross(n_ws, tangent_ws) * (side * y) + n_ws * z;
  return select(dot(n, n) > R(0), n, n_ws);
}

/// The changes in height to the next pixel to the right and to the next pixel up.
template <class R>
struct HeightSteps {
  R right, up;
};

/// Uses a map that stores (∂h/∂u, ∂h/∂v), the slopes of the filtered heights.
template <class R>
HS_INLINE HeightSteps<R> height_steps(const DetailMap& detail, const MapCoordinates<R>& at) {
  const vec3<R> slope = detail.map->sample_rgb(detail.sampler, at.uv, at.duv_dx, at.duv_dy);
  const R s(detail.strength);
  return {s * fma(slope.x, at.duv_dx.x, slope.y * at.duv_dx.y), s * fma(slope.x, at.duv_dy.x, slope.y * at.duv_dy.y)};
}

/// Uses a map that stores h, and takes differences within the 2x2 quad, like dFdx and dFdy in GLSL. All four pixels of a quad get the
/// same value, which is visible as blocks. uv_of(varyings) must return the texture coordinates.
template <class V, class R, class F>
HS_INLINE HeightSteps<R> height_differences(const DetailMap& detail, const Pixel<R>& px, const MapCoordinates<R>& at, const F& uv_of) {
  std::array<R, 3> h;
  for (int k = 0; k < 3; ++k) {
    const vec2<R> uv = uv_of(px.template at_quad<V>(k & 1, k >> 1));
    h[static_cast<std::size_t>(k)] = detail.map->sample_rgb(detail.sampler, uv, at.duv_dx, at.duv_dy).x;
  }
  const R s(detail.strength);
  return {s * (h[1] - h[0]), s * (h[2] - h[0])};
}

/// Returns the normal of a surface that is displaced by h along its unit normal n. dp_dx and dp_dy are the changes in the position
/// to the next pixel to the right and to the next pixel up. The result is n − ∇h with the surface gradient
///
///   ∇h = (h_x · (p_y × n) + h_y · (n × p_x)) / (p_x · (p_y × n))
///
/// M. Mikkelsen, "Bump mapping unparametrized surfaces on the GPU", 2010. A surface seen edge-on keeps n.
template <class R>
HS_INLINE vec3<R> normal_from_heights(const vec3<R>& n, const HeightSteps<R>& h, const vec3<R>& dp_dx, const vec3<R>& dp_dy) {
  const vec3<R> right = cross(dp_dy, n), up = cross(n, dp_dx);
  const R determinant = dot(dp_dx, right);
  const R inverse = select(determinant == R(0), R(0), R(1) / determinant);
  return n - (right * h.right + up * h.up) * inverse;
}

/// Returns the normal of a displaced sphere where the unit normal of the sphere is n, with y towards the north pole. slope is
/// (∂g/∂east, ∂g/∂north, 1 + g/r), and the result is n·(1 + g/r) − east·∂g/∂east − north·∂g/∂north (derived in
/// geometry/height_field.h). At the poles, where east is undefined, the slopes have no effect.
template <class R>
HS_INLINE vec3<R> normal_from_slopes(const vec3<R>& n, const vec3<R>& slope) {
  const R ring = sqrt(fma(n.x, n.x, n.z * n.z));
  const R inverse = select(ring > R(0), R(1) / ring, R(0));
  const vec3<R> east(n.z * inverse, R(0), -n.x * inverse);
  const vec3<R> north(-n.y * n.x * inverse, ring, -n.y * n.z * inverse);
  return n * slope.z - east * slope.x - north * slope.y;
}

}  // namespace halfspace::HS_LANES
