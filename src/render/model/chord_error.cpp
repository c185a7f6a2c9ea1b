// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/model/chord_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "halfspace/core/trig_double.h"

namespace halfspace {

namespace {

// Returns the distance between an arc of 2π/n and its chord.
double chord_error_of_circle(double radius, int n) {
  const double s = sincos_turns(0.25 / n).sin;
  return 2.0 * radius * s * s;  // 1 − cos x = 2 sin²(x/2)
}

// Chord error along the trefoil knot (torus_knot.cpp): an eighth of the maximum second derivative of the curve, divided by n². The
// maximum is at the outermost point, where the center line contributes 36.8π²·R and the tube's radius 52π²·t.
double chord_error_along_knot(double radius, double tube, int n) {
  return std::numbers::pi * std::numbers::pi * (4.6 * radius + 6.5 * tube) / (static_cast<double>(n) * n);
}

// Chord error of an icosphere of radius 1 at level 0. At level 1 and above it is kIcosphereError / 4^level.
constexpr double kIcosahedronError = 0.2054, kIcosphereError = 0.292;

}  // namespace

double chord_error(const ObjectDescription& o) {
  switch (o.shape) {
    case Shape::uv_sphere: {
      // The circumcircle of a triangle passes through the ends of the quad's diagonal.
      const double along = 1.0 / (4.0 * o.latitudes), across = 1.0 / (2.0 * o.longitudes);  // turns to the middle of the diagonal
      const double s = sincos_turns(0.5 * std::sqrt(along * along + across * across)).sin;
      return 2.0 * o.radius * s * s;
    }
    case Shape::icosphere: return o.radius * (o.level == 0 ? kIcosahedronError : kIcosphereError / static_cast<double>(1 << (2 * o.level)));
    case Shape::cylinder:
    case Shape::cone: return chord_error_of_circle(o.radius, o.longitudes);
    case Shape::torus: return chord_error_of_circle(o.tube, o.latitudes) + chord_error_of_circle(o.radius + o.tube, o.longitudes);
    case Shape::torus_knot: return chord_error_of_circle(o.tube, o.latitudes) + chord_error_along_knot(o.radius, o.tube, o.longitudes);
    case Shape::sphere:
    case Shape::file:
    case Shape::plane:
    case Shape::cube: break;
  }
  return 0.0;
}

int part_step(int minimum) {
  int power = 1;
  while (2 * power <= minimum) power *= 2;
  if (minimum <= power) return power;
  return 2 * minimum <= 3 * power ? 3 * power / 2 : 2 * power;
}

namespace {

int scaled(int parts, double factor) { return std::max(3, static_cast<int>(std::ceil(parts * factor))); }

// Returns the number of bands of a cylinder or cone, which are straight from top to bottom.
int rows_of_cone(const ObjectDescription& o, int sectors, bool places_maps) {
  if (is_map(o.height)) return scaled(sectors, static_cast<double>(o.latitudes) / o.longitudes);
  // With sectors/3 bands, s/4n = 2πr/(4·sectors·sectors/3) = 4.7 r/sectors², which is below the chord error of 4.9 r/sectors².
  if (places_maps && o.shape == Shape::cone && !first_map(o.surface).empty()) return scaled(sectors, 1.0 / 3.0);
  return 2;
}

}  // namespace

ObjectDescription with_parts(ObjectDescription o, int parts, bool places_maps) {
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
      o.latitudes = rows_of_cone(o, parts, places_maps);
      o.longitudes = std::max(3, parts);
      break;
    case Shape::torus:
      o.latitudes = std::max(3, parts);
      o.longitudes = scaled(parts, std::sqrt((o.radius + o.tube) / o.tube));
      break;
    case Shape::torus_knot:
      // The chord error around the tube is t·(π/n)²/2.
      o.latitudes = std::max(3, parts);
      o.longitudes = scaled(parts, std::sqrt(2.0 * (4.6 * o.radius + 6.5 * o.tube) / o.tube));
      break;
    case Shape::plane:
    case Shape::cube: o.segments = parts; break;
    case Shape::sphere:
    case Shape::file: break;
  }
  return o;
}

int max_parts(const ObjectDescription& o) {
  switch (o.shape) {
    case Shape::icosphere: return 1 << 8;
    case Shape::plane:
    case Shape::cube: return 1024;
    case Shape::cylinder:
    case Shape::cone: return 8192;
    case Shape::torus: return 512;
    case Shape::torus_knot: return 256;
    case Shape::uv_sphere:
    case Shape::sphere:
    case Shape::file: break;
  }
  return 1536;
}

}  // namespace halfspace
