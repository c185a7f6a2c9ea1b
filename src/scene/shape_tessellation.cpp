// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/shape_tessellation.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "halfspace/core/trig_double.h"

namespace halfspace::HS_LANES {

namespace {

using Object = ObjectDescription;
using std::numbers::pi;

// Returns the distance between an arc of 2π/n and its chord.
double chord_error_of_circle(double radius, int n) {
  const double s = sincos_turns(0.25 / n).sin;
  return 2.0 * radius * s * s;  // 1 − cos x = 2 sin²(x/2)
}

// With n segments along the knot and around its tube, the ratio of the two chord errors equals the ratio of this length to the tube's
// radius. The error along the knot (torus_knot.cpp) is an eighth of the maximum second derivative of the curve, divided by n². The maximum
// is at the outermost point, where the center line contributes 36.8π²·R and the tube's radius 52π²·t.
double knot_bend(const Object& o) { return 4.6 * o.radius + 6.5 * o.tube; }

int scaled(int parts, double factor) { return std::max(3, static_cast<int>(std::ceil(parts * factor))); }

}  // namespace

// ---- errors ----------------------------------------------------------------------------------------------------

// The circumcircle of a triangle passes through the ends of the quad's diagonal.
double sphere_chord_error(const Object& o) {
  const double along = 1.0 / (4.0 * o.latitudes), across = 1.0 / (2.0 * o.longitudes);  // turns to the middle of the diagonal
  const double s = sincos_turns(0.5 * std::sqrt(along * along + across * across)).sin;
  return 2.0 * o.radius * s * s;
}

// Chord error of an icosphere of radius 1 at level 0. At level 1 and above it is kIcosphereError / 4^level.
constexpr double kIcosahedronError = 0.2054, kIcosphereError = 0.292;

double icosphere_chord_error(const Object& o) {
  return o.radius * (o.level == 0 ? kIcosahedronError : kIcosphereError / static_cast<double>(1 << (2 * o.level)));
}

double cone_chord_error(const Object& o) { return chord_error_of_circle(o.radius, o.longitudes); }

double torus_chord_error(const Object& o) {
  return chord_error_of_circle(o.tube, o.latitudes) + chord_error_of_circle(o.radius + o.tube, o.longitudes);
}

double knot_chord_error(const Object& o) {
  return chord_error_of_circle(o.tube, o.latitudes) + pi * pi * knot_bend(o) / (static_cast<double>(o.longitudes) * o.longitudes);
}

double icosphere_angle(const Object& o) { return 1.33 / static_cast<double>(1 << o.level); }
double sphere_angle(const Object& o) { return glm::length(glm::dvec2(pi / o.latitudes, 2.0 * pi / o.longitudes)); }
double cone_angle(const Object& o) { return 2.0 * pi / o.longitudes; }
double ring_angle(const Object& o) { return glm::length(glm::dvec2(2.0 * pi / o.latitudes, 2.0 * pi / o.longitudes)); }

// ---- tessellation ----------------------------------------------------------------------------------------------

void no_parts(Object&, int, bool) {}

void sphere_parts(Object& o, int parts, bool) {
  o.latitudes = parts;
  o.longitudes = 2 * parts;
}

void icosphere_parts(Object& o, int parts, bool) {
  o.level = 0;
  while (o.level < 8 && (1 << o.level) < parts) ++o.level;
}

void edge_parts(Object& o, int parts, bool) { o.segments = parts; }

// Cylinders and cones are straight from top to bottom.
void cylinder_parts(Object& o, int parts, bool) {
  o.latitudes = is_map(o.height) ? scaled(parts, static_cast<double>(o.latitudes) / o.longitudes) : 2;
  o.longitudes = std::max(3, parts);
}

void cone_parts(Object& o, int parts, bool places_maps) {
  cylinder_parts(o, parts, places_maps);
  // With sectors/3 bands, s/4n = 2πr/(4·sectors·sectors/3) = 4.7 r/sectors², which is below the chord error of 4.9 r/sectors².
  if (places_maps && !is_map(o.height) && !first_map(o.surface).empty()) o.latitudes = scaled(parts, 1.0 / 3.0);
}

void torus_parts(Object& o, int parts, bool) {
  o.latitudes = std::max(3, parts);
  o.longitudes = scaled(parts, std::sqrt((o.radius + o.tube) / o.tube));
}

// The chord error around the tube is t·(π/n)²/2.
void knot_parts(Object& o, int parts, bool) {
  o.latitudes = std::max(3, parts);
  o.longitudes = scaled(parts, std::sqrt(2.0 * knot_bend(o) / o.tube));
}

}  // namespace halfspace::HS_LANES
