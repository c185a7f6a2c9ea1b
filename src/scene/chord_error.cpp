// SPDX-License-Identifier: Apache-2.0
#include "scene/chord_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/trig_double.h"

namespace halfspace {

namespace {

// Between an arc of 2π/n and its chord.
double chord_error_of_circle(double radius, int n) {
  const double s = sincos_turns(0.25 / n).sin;
  return 2.0 * radius * s * s;  // 1 − cos x = 2 sin²(x/2)
}

// Along a trefoil (torus_knot.cpp): an eighth of the curve's second derivative over n², where that is largest. There, at the
// outmost place, the middle line turns by 36.8π²·R and the tube's radius by 52π²·t.
double chord_error_along_knot(double radius, double tube, int n) {
  return std::numbers::pi * std::numbers::pi * (4.6 * radius + 6.5 * tube) / (static_cast<double>(n) * n);
}

// Of an icosphere of radius 1 at level 0, and at level 1 times 4: further levels quarter it.
constexpr double kIcosahedronError = 0.2054, kIcosphereError = 0.292;

}  // namespace

double chord_error(const ObjectDescription& o) {
  switch (o.shape) {
    case Shape::uv_sphere: {
      // The triangle's circle goes through the ends of its diagonal.
      const double along = 1.0 / (4.0 * o.latitudes), across = 1.0 / (2.0 * o.longitudes);  // turns to the diagonal's middle
      const double s = sincos_turns(0.5 * std::sqrt(along * along + across * across)).sin;
      return 2.0 * o.radius * s * s;
    }
    case Shape::icosphere: return o.radius * (o.level == 0 ? kIcosahedronError : kIcosphereError / static_cast<double>(1 << (2 * o.level)));
    case Shape::cylinder:
    case Shape::cone: return chord_error_of_circle(o.radius, o.longitudes);
    case Shape::torus: return chord_error_of_circle(o.tube, o.latitudes) + chord_error_of_circle(o.radius + o.tube, o.longitudes);
    case Shape::torus_knot: return chord_error_of_circle(o.tube, o.latitudes) + chord_error_along_knot(o.radius, o.tube, o.longitudes);
    case Shape::plane:
    case Shape::cube: break;
  }
  return 0.0;
}

int part_step(int least) {
  int power = 1;
  while (2 * power <= least) power *= 2;
  if (least <= power) return power;
  return 2 * least <= 3 * power ? 3 * power / 2 : 2 * power;
}

namespace {

int scaled(int parts, double factor) { return std::max(3, static_cast<int>(std::ceil(parts * factor))); }

}  // namespace

ObjectDescription with_parts(ObjectDescription o, int parts) {
  switch (o.shape) {
    case Shape::uv_sphere:
      o.latitudes = parts;
      o.longitudes = 2 * parts;
      break;
    case Shape::icosphere:
      o.level = 0;
      while (o.level < 8 && (1 << o.level) < parts) ++o.level;
      break;
    case Shape::cylinder:
    case Shape::cone:
      // Without heights straight from top to bottom.
      o.latitudes =
          is_map(o.height) ? std::max(2, static_cast<int>(std::ceil(static_cast<double>(parts) * o.latitudes / o.longitudes))) : 2;
      o.longitudes = std::max(3, parts);
      break;
    case Shape::torus:
      o.latitudes = std::max(3, parts);
      o.longitudes = scaled(parts, std::sqrt((o.radius + o.tube) / o.tube));
      break;
    case Shape::torus_knot:
      // t·(π/n)²/2 round the tube
      o.latitudes = std::max(3, parts);
      o.longitudes = scaled(parts, std::sqrt(2.0 * (4.6 * o.radius + 6.5 * o.tube) / o.tube));
      break;
    case Shape::plane:
    case Shape::cube: o.segments = parts; break;
  }
  return o;
}

int most_parts(const ObjectDescription& o) {
  switch (o.shape) {
    case Shape::icosphere: return 1 << 8;
    case Shape::plane:
    case Shape::cube: return 1024;
    case Shape::cylinder:
    case Shape::cone: return 8192;
    case Shape::torus: return 512;
    case Shape::torus_knot: return 256;
    case Shape::uv_sphere: break;
  }
  return 1536;
}

namespace {

double corner_tangent_squared(const View& v) { return v.tan_x * v.tan_x + v.tan_y * v.tan_y; }
double focal_px(const View& v) { return 0.5 * v.height_px / v.tan_y; }
bool is_orthographic(const View& v) { return v.to_eye_ws != glm::dvec3(0.0); }

glm::dvec4 row_of(const glm::dmat4& m, int i) { return {m[0][i], m[1][i], m[2][i], m[3][i]}; }

double orthographic_pixels(const View& v) { return 0.5 * v.height_px * glm::length(glm::dvec3(row_of(v.clip_from_world, 1))); }

}  // namespace

double pixels_per_unit(const View& v, const glm::dvec3& center_ws, double radius) {
  if (is_orthographic(v)) return orthographic_pixels(v);
  const double nearest = std::max(v.near, glm::dot(center_ws - v.eye_ws, v.forward_ws) - radius);
  // A move along the ray of a corner shows √(1 + tan²) of itself over the depth at the most.
  return focal_px(v) * std::sqrt(1.0 + corner_tangent_squared(v)) / nearest;
}

double silhouette_pixels_per_unit(const View& v, const glm::dvec3& center_ws, double radius) {
  if (is_orthographic(v)) return orthographic_pixels(v);
  const glm::dvec3 from_eye = center_ws - v.eye_ws;
  const double distance_squared = glm::dot(from_eye, from_eye), depth = glm::dot(from_eye, v.forward_ws);
  if (distance_squared <= radius * radius) return pixels_per_unit(v, center_ws, radius);
  // The silhouette is seen at the angle α from the centre, sin α = r/d; less radius by δ turns it by δ/√(d² − r²). The picture
  // stretches angles by 1 + tan²θ, θ from its middle.
  const double tangent_length = std::sqrt(distance_squared - radius * radius);
  const double corner = std::sqrt(corner_tangent_squared(v));
  double farthest = corner;
  if (depth > 0.0) {
    const double center = std::sqrt(std::max(0.0, distance_squared - depth * depth)) / depth, own = radius / tangent_length;
    if (center * own < 1.0) farthest = std::min(corner, (center + own) / (1.0 - center * own));
  }
  return focal_px(v) * (1.0 + farthest * farthest) / tangent_length;
}

bool is_outside(const View& v, const glm::dvec3& center_ws, double radius) {
  const glm::dvec4 w = row_of(v.clip_from_world, 3);
  for (const int axis : {0, 1}) {
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec4 plane = w + side * row_of(v.clip_from_world, axis);
      if (glm::dot(plane, glm::dvec4(center_ws, 1.0)) < -radius * glm::length(glm::dvec3(plane))) return true;
    }
  }
  return false;
}

}  // namespace halfspace
