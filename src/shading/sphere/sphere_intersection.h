// SPDX-License-Identifier: Apache-2.0
//
// Geometry of spheres in a view: screen-space bounds, and the intersection with the ray of a pixel and its depth.
//
// All positions are in camera space (suffix _cs): x right, y up, z forward from the eye, in world units.
//
// The ray of a pixel is t·d with d = (dx, dy, 1), where t is the depth along z; in an orthographic view it is (dx, dy, t). The
// computation starts where the ray crosses the plane z = c.z through the center c of the sphere. Relative to c this is the point
// e = d·c.z − c, which has z = 0, so that all lengths are on the order of the radius even if the sphere is far away. The distance δ from a
// point p = e + s·d of the ray to the sphere satisfies, with a = d·d:
//   a·δ² + 2·(p·d)·δ + |p|² − r² = 0, δ = (−p·d − √((p·d)² + a·(r² − |p|²))) / a, t = c.z + s + δ, normal = (p + δ·d) / r.
// If p is the point closest to the center, s = −(e·d)/a, then p·d is only a rounding error, and r² − |p|² measures how deep the ray enters
// the sphere. At the silhouette it is 0 and consists of the accumulated rounding errors. For that reason d, e, p and this difference are
// kept as sums of two floats (exact products and sums by Dekker and Knuth). It is then accurate to about 2^-44·r², and the root and the
// normal have full float precision up to the silhouette. Cases within 2^-38·r² of the boundary between hit and miss are decided in double.
//
// δ is of the order of the radius. If the eye is close to the sphere (r is more than a fifth of the distance to the center), c.z + s + δ
// may suffer from cancellation, and the depth needs δ to more than float precision. One Newton step from s + δ, again in sums of two
// floats, provides it.
#pragma once

#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"

namespace halfspace::HS_LANES {

/// A double, stored as the sum of two floats.
struct SplitDouble {
  float high = 0.0f, low = 0.0f;
  SplitDouble() = default;
  explicit SplitDouble(double d) : high(static_cast<float>(d)), low(static_cast<float>(d - static_cast<double>(high))) {}
};

/// A number represented as the sum of two; high is the rounded sum.
template <class R>
struct DoubleFloat {
  R high, low;
};
/// Returns a + b exactly (Knuth).
template <class R>
HS_INLINE DoubleFloat<R> two_sum(R a, R b) {
  const R sum = a + b, back = sum - a;
  return {sum, (a - (sum - back)) + (b - back)};
}
/// Returns a · b exactly (Dekker).
template <class R>
HS_INLINE DoubleFloat<R> two_product(R a, R b) {
  const R product = a * b;
  return {product, fma(a, b, -product)};
}

/// A linear function of a window coordinate.
struct PixelLine {
  SplitDouble scale, bias;

  template <class R>
  HS_INLINE DoubleFloat<R> at(R x) const {
    const DoubleFloat<R> product = two_product(x, R(scale.high)), sum = two_sum(product.high, R(bias.high));
    return two_sum(sum.high, (sum.low + product.low) + fma(x, R(scale.low), R(bias.low)));
  }
};

/// Intersection of a ray with a sphere.
template <class R>
struct SphereHit {
  MaskOf<R> seen;  ///< the ray enters the sphere between the near and far planes
  R t, t_low;      ///< depth along z in world units: t, and its rounding error
  vec3<R> n_cs;    ///< outward unit normal
};

/// An interval in NDC.
template <class R>
struct SphereSpan {
  R low, high;
};

/// Projection of spheres by a camera.
struct SphereIntersection {
  bool perspective = true;
  glm::vec2 half{1.0f};                              ///< half the extent of the view: tangents, or world units if orthographic
  glm::vec2 pixel_ndc{0.0f};                         ///< size of a pixel in NDC
  float near = 0.1f, far = 1000.0f, far_low = 0.0f;  ///< far + far_low is the value in double
  float depth_scale = 0.0f, depth_scale_low = 0.0f;
  PixelLine ray_x, ray_y;  ///< map window coordinates to dx and dy

  SphereIntersection() = default;
  /// size_px is the size of the image in pixels. Depth is reversed: 1 at near, 0 at far.
  SphereIntersection(bool is_perspective, const glm::dvec2& half_extent, double z_near, double z_far, const glm::ivec2& size_px)
      : perspective(is_perspective),
        half(half_extent),
        pixel_ndc(2.0 / glm::dvec2(size_px)),
        near(static_cast<float>(z_near)),
        far(SplitDouble(z_far).high),
        far_low(SplitDouble(z_far).low),
        depth_scale(SplitDouble((is_perspective ? z_near : 1.0) / (z_far - z_near)).high),
        depth_scale_low(SplitDouble((is_perspective ? z_near : 1.0) / (z_far - z_near)).low),
        ray_x{SplitDouble(2.0 * half_extent.x / size_px.x), SplitDouble(-half_extent.x)},
        ray_y{SplitDouble(2.0 * half_extent.y / size_px.y), SplitDouble(-half_extent.y)} {}

  /// Returns the window depth at the depth t + t_low, clamped to [0, 1].
  template <class R>
  HS_INLINE R window_depth(R t, R t_low = R(0)) const {
    const R from_far = (R(far) - t) + (R(far_low) - t_low);
    const R scaled = fma(R(depth_scale), from_far, R(depth_scale_low) * from_far);
    if (!perspective) return clamp(scaled, R(0), R(1));
    const R clamped = max(t, R(near)), inverse = R(1) / clamped, quotient = scaled * inverse;
    const R rest = fma(-quotient, clamped, scaled) - quotient * t_low;
    return clamp(fma(rest, inverse, quotient), R(0), R(1));
  }

  /// Intersects the ray through the window coordinates x and y with a sphere of radius r > 0. The part in front of the near plane
  /// is clipped: a ray that enters the sphere there does not hit it, as for a closed mesh with back-face culling.
  template <class R>
  HS_INLINE SphereHit<R> hit(const vec3<R>& center_cs, R radius, R x, R y) const {
    const vec3<R>& c = center_cs;
    const Ray<R> ray = ray_of(c, x, y);
    const R a = fma(ray.dx.high, ray.dx.high, fma(ray.dy.high, ray.dy.high, R(1)));
    R s = -fma(ray.ex.high, ray.dx.high, ray.ey.high * ray.dy.high) / a;  // closest to the center, except for rounding
    RayPoint<R> p = point_at(ray, s);
    const R forward = p.forward(ray);
    R root = fma(forward, forward, a * p.inside(radius));
    const MaskOf<R> close_call = abs(root) < R(0x1p-38f) * a * radius * radius;
    if (any(close_call)) decide_in_double(close_call, c, radius, x, y, root);
    R delta = -(forward + sqrt(max(root, R(0)))) / a;
    const MaskOf<R> is_near = R(25) * radius * radius > dot(c, c);
    if (any(is_near)) {
      s = select(is_near, s + delta, s);
      p = point_at(ray, s);
      const R slope = R(2) * p.forward(ray);  // negative if the ray enters
      delta = select(is_near, select(slope < R(0), p.inside(radius) / slope, R(0)), delta);
    }
    DoubleFloat<R> t = two_sum(c.z, s);
    t = two_sum(t.high, t.low + delta);
    const vec3<R> n = vec3<R>(fma(delta, ray.dx.high, p.x.high), fma(delta, ray.dy.high, p.y.high), s + delta) * (R(1) / radius);
    return {(root > R(0)) && (t.high >= R(near)) && (t.high <= R(far)), t.high, t.low, n};
  }

  /// Returns whether any part of the sphere is between near and far.
  template <class R>
  HS_INLINE MaskOf<R> in_depth(const vec3<R>& center_cs, R radius) const {
    return (radius > R(0)) && (center_cs.z + radius > R(near)) && (center_cs.z - radius < R(far));
  }

  /// Returns the interval that the part of the sphere beyond the near plane covers along an axis (0: x, 1: y), extended on both
  /// sides by an eighth of a pixel and a bound on the rounding error.
  template <class R>
  HS_INLINE SphereSpan<R> span(const vec3<R>& center_cs, R radius, int axis) const {
    const R scale(1.0f / half[axis]);
    const R low = edge(center_cs[axis], center_cs.z, radius, R(-1)), high = edge(center_cs[axis], center_cs.z, radius, R(1));
    return {low * scale - margin(low * scale, center_cs[axis], center_cs.z, radius, pixel_ndc[axis]),
            high * scale + margin(high * scale, center_cs[axis], center_cs.z, radius, pixel_ndc[axis])};
  }

 private:
  /// Returns the discriminant of the intersection, computed in double. It is positive if the ray hits the sphere.
  double root_in_double(const glm::vec3& center_cs, float radius, float x, float y) const;
  // Resolves the rare cases that the precision of two floats cannot decide. They occur in about one of many million pixels.
  template <class R>
  HS_INLINE void decide_in_double(MaskOf<R> which, const vec3<R>& c, R radius, R x, R y, R& root) const {
    if constexpr (std::is_same_v<decltype(lane(radius, 0)), float>) {
      for (int i = 0; i < kWidthOf<R>; ++i) {
        if (!lane(which, i)) continue;
        const glm::vec3 center(lane(c.x, i), lane(c.y, i), lane(c.z, i));
        set_lane(root, i, static_cast<float>(root_in_double(center, lane(radius, i), lane(x, i), lane(y, i))));
      }
    }
  }

  // A ray as described above: d without its z component, which is 1, and e.
  template <class R>
  struct Ray {
    DoubleFloat<R> dx, dy, ex, ey;
  };
  // e + s·d
  template <class R>
  struct RayPoint {
    DoubleFloat<R> x, y;
    R z;

    /// p·d
    HS_INLINE R forward(const Ray<R>& ray) const { return fma(x.high, ray.dx.high, fma(y.high, ray.dy.high, z)); }
    /// r² − |p|². Near the surface the leading parts of the four squares cancel exactly (Sterbenz).
    HS_INLINE R inside(R r) const {
      const DoubleFloat<R> xx = two_product(x.high, x.high), yy = two_product(y.high, y.high), zz = two_product(z, z),
                           rr = two_product(r, r);
      const DoubleFloat<R> xy = two_sum(xx.high, yy.high), xyz = two_sum(xy.high, zz.high), left = two_sum(rr.high, -xyz.high);
      const R squares_low = (xx.low + yy.low) + (zz.low + (xy.low + xyz.low));
      return left.high + ((left.low - squares_low) + (rr.low - R(2) * fma(x.high, x.low, y.high * y.low)));
    }
  };

  // base + s·along
  template <class R>
  HS_INLINE static DoubleFloat<R> step(const DoubleFloat<R>& base, const DoubleFloat<R>& along, R s) {
    const DoubleFloat<R> product = two_product(s, along.high), sum = two_sum(product.high, base.high);
    return two_sum(sum.high, (sum.low + product.low) + fma(s, along.low, base.low));
  }
  template <class R>
  HS_INLINE static RayPoint<R> point_at(const Ray<R>& ray, R s) {
    return {step(ray.ex, ray.dx, s), step(ray.ey, ray.dy, s), s};
  }
  template <class R>
  HS_INLINE Ray<R> ray_of(const vec3<R>& c, R x, R y) const {
    const DoubleFloat<R> px = ray_x.at(x), py = ray_y.at(y), none{R(0), R(0)}, from_x{-c.x, R(0)}, from_y{-c.y, R(0)};
    if (perspective) return {px, py, step(from_x, px, c.z), step(from_y, py, c.z)};
    return {none, none, step(from_x, px, R(1)), step(from_y, py, R(1))};
  }

  // Returns the maximum (side 1) or minimum (side −1) of x/z over the part of the disk around (x, z) that is beyond the near plane. It
  // is at the tangent from the eye or, if that touches the disk in front of the plane, at the end of the chord that the plane cuts
  // from the disk. For orthographic views it is the maximum or minimum of x.
  template <class R>
  HS_INLINE R edge(R x, R z, R r, R side) const {
    if (!perspective) return fma(side, r, x);
    const R squared = fma(x, x, z * z), tangent_squared = squared - r * r;
    const R tangent = sqrt(max(tangent_squared, R(0)));
    const R touch_x = fma(side * r, z, x * tangent), touch_z = fma(-side * r, x, z * tangent);  // scaled by |c|² / tangent
    const R down = R(near) - z, chord = sqrt(max(fma(-down, down, r * r), R(0)));
    const MaskOf<R> touches = (tangent_squared > R(0)) && (touch_z * tangent >= R(near) * squared);
    return select(touches, touch_x / select(touches, touch_z, R(1)), fma(side, chord, x) / R(near));
  }

  // The length of the tangent comes from a difference of squares, whose relative error grows as the eye approaches the surface.
  template <class R>
  HS_INLINE R margin(R ndc, R x, R z, R r, float pixel) const {
    const R squared = fma(x, x, z * z), left = max(abs(squared - r * r), squared * R(0x1p-20f));
    return R(0.125f * pixel) + abs(ndc) * (R(0x1p-20f) + R(0x1p-22f) * (squared / left));
  }
};

}  // namespace halfspace::HS_LANES
