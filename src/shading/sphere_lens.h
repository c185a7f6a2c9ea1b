// SPDX-License-Identifier: Apache-2.0
//
// A sphere as a picture sees it: its bounds in the picture, where a pixel's ray meets it, and how deep that lies.
//
// All is told in the camera's axes, suffix _cs: x to the right, y up, z forward from the eye, in units.
//
// The ray of a pixel is t·d with d = (dx, dy, 1) and t the depth along z, or (dx, dy, t) in an orthographic picture. It is
// followed from where it crosses the plane z = c.z of the sphere's centre c: there it is at e = d·c.z − c from the centre, which
// has no z, and |e + s·d| = r is solved for s. So all lengths are of the sphere's size, however far it is:
//   a = d·d, b = e·d, s = (−b − √(a·r² − |e × d|²)) / a, t = c.z + s, normal = (e + s·d) / r.
// That |e × d|² stands in the root, and not b² − a·(e·e − r²), keeps what distant and small spheres would lose.
#pragma once

#include "core/lane_math.h"
#include "core/vec.h"

namespace halfspace {

/// A double as the sum of two floats.
struct SplitDouble {
  float high = 0.0f, low = 0.0f;
  SplitDouble() = default;
  explicit SplitDouble(double d) : high(static_cast<float>(d)), low(static_cast<float>(d - static_cast<double>(high))) {}
};

/// x · scale + bias, with what the rounding of the sum took away.
template <class R>
struct SplitSum {
  R high, low;
};

/// A line through window coordinates.
struct PixelLine {
  SplitDouble scale, bias;

  template <class R>
  HS_INLINE SplitSum<R> at(R x) const {
    const R product = x * R(scale.high), product_low = fma(x, R(scale.high), -product);
    const R sum = product + R(bias.high), back = sum - product;
    const R sum_low = (product - (sum - back)) + (R(bias.high) - back);  // Knuth's two-sum
    return {sum, (sum_low + product_low) + fma(x, R(scale.low), R(bias.low))};
  }
};

/// Where a ray meets a sphere.
template <class R>
struct SphereHit {
  MaskOf<R> seen;  ///< the ray enters the sphere between near and far
  R t;             ///< depth along z, units
  vec3<R> n_cs;    ///< unit normal, outwards
};

/// From low to high in normalized device coordinates.
template <class R>
struct SphereSpan {
  R low, high;
};

/// How a camera sees spheres.
struct SphereLens {
  bool perspective = true;
  glm::vec2 half{1.0f};       ///< what reaches from the picture's middle to its edges: tangents, or in an orthographic picture units
  glm::vec2 pixel_ndc{0.0f};  ///< size of a pixel in normalized device coordinates
  float near = 0.1f, far = 1000.0f;
  float depth_scale = 0.0f;
  PixelLine ray_x, ray_y;  ///< from window coordinates to dx and dy

  SphereLens() = default;
  /// size_px: of the picture. Depth is reversed: 1 at near, 0 at far.
  SphereLens(bool is_perspective, const glm::dvec2& half_extent, double z_near, double z_far, const glm::ivec2& size_px)
      : perspective(is_perspective),
        half(half_extent),
        pixel_ndc(2.0 / glm::dvec2(size_px)),
        near(static_cast<float>(z_near)),
        far(static_cast<float>(z_far)),
        depth_scale(static_cast<float>((is_perspective ? z_near : 1.0) / (z_far - z_near))),
        ray_x{SplitDouble(2.0 * half_extent.x / size_px.x), SplitDouble(-half_extent.x)},
        ray_y{SplitDouble(2.0 * half_extent.y / size_px.y), SplitDouble(-half_extent.y)} {}

  /// Window depth of depth t, held to [0, 1].
  template <class R>
  HS_INLINE R window_depth(R t) const {
    const R from_far = R(depth_scale) * (R(far) - t);
    return clamp(perspective ? from_far / max(t, R(near)) : from_far, R(0), R(1));
  }

  /// The ray of the window coordinates x and y, and a sphere of radius r > 0. What lies before the near plane is cut away: a
  /// pixel whose ray enters the sphere there sees nothing of it, as of a closed surface whose back faces are culled.
  template <class R>
  HS_INLINE SphereHit<R> hit(const vec3<R>& center_cs, R radius, R x, R y) const {
    const SplitSum<R> px = ray_x.at(x), py = ray_y.at(y);
    const vec3<R>& c = center_cs;
    R dx(0), dy(0), ex = (px.high - c.x) + px.low, ey = (py.high - c.y) + py.low;
    if (perspective) {
      dx = px.high;
      dy = py.high;
      ex = fma(px.low, c.z, fma(dx, c.z, -c.x));
      ey = fma(py.low, c.z, fma(dy, c.z, -c.y));
    }
    const R a = fma(dx, dx, fma(dy, dy, R(1)));
    const R b = fma(ex, dx, ey * dy);
    const R twist = difference_of_products(ex, dy, ey, dx);  // e × d = (ey, −ex, twist)
    const R root = a * radius * radius - fma(twist, twist, fma(ex, ex, ey * ey));
    const R s = -(b + sqrt(max(root, R(0)))) / a;
    const R t = c.z + s, inverse = R(1) / radius;
    return {(root > R(0)) && (t >= R(near)) && (t <= R(far)), t, vec3<R>(fma(s, dx, ex), fma(s, dy, ey), s) * inverse};
  }

  /// Does any of the sphere lie between near and far?
  template <class R>
  HS_INLINE MaskOf<R> in_depth(const vec3<R>& center_cs, R radius) const {
    return (radius > R(0)) && (center_cs.z + radius > R(near)) && (center_cs.z - radius < R(far));
  }

  /// What the part of the sphere beyond the near plane spans along an axis (0: x, 1: y), with an eighth of a pixel and what
  /// rounding may take on either side.
  template <class R>
  HS_INLINE SphereSpan<R> span(const vec3<R>& center_cs, R radius, int axis) const {
    const R scale(1.0f / half[axis]);
    const R low = edge(center_cs[axis], center_cs.z, radius, R(-1)), high = edge(center_cs[axis], center_cs.z, radius, R(1));
    return {low * scale - margin(low * scale, center_cs[axis], center_cs.z, radius, pixel_ndc[axis]),
            high * scale + margin(high * scale, center_cs[axis], center_cs.z, radius, pixel_ndc[axis])};
  }

 private:
  // Largest (side 1) or least (side −1) x/z of the disk round (x, z) where it lies beyond the near plane: that of the tangent
  // from the eye, or where that touches before the plane, of the disk's chord in it. Orthographic: largest or least x.
  template <class R>
  HS_INLINE R edge(R x, R z, R r, R side) const {
    if (!perspective) return fma(side, r, x);
    const R squared = fma(x, x, z * z), tangent_squared = squared - r * r;
    const R tangent = sqrt(max(tangent_squared, R(0)));
    const R touch_x = fma(side * r, z, x * tangent), touch_z = fma(-side * r, x, z * tangent);  // times |c|² / tangent
    const R down = R(near) - z, chord = sqrt(max(fma(-down, down, r * r), R(0)));
    const MaskOf<R> touches = (tangent_squared > R(0)) && (touch_z * tangent >= R(near) * squared);
    return select(touches, touch_x / select(touches, touch_z, R(1)), fma(side, chord, x) / R(near));
  }

  // The tangent's length is a difference of squares, which is the less certain the nearer the eye is to the surface.
  template <class R>
  HS_INLINE R margin(R ndc, R x, R z, R r, float pixel) const {
    const R squared = fma(x, x, z * z), left = max(abs(squared - r * r), squared * R(0x1p-20f));
    return R(0.125f * pixel) + abs(ndc) * (R(0x1p-20f) + R(0x1p-22f) * (squared / left));
  }
};

}  // namespace halfspace
