// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/particles.h"

#include <cmath>
#include <numbers>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/hash.h"
#include "halfspace/core/trig_double.h"

namespace halfspace::HS_LANES {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;  // radians

// Computes the cube root of x > 0 by Newton's method, without libm. The iterates decrease towards the root; the loop ends when they stop
// decreasing.
double cube_root(double x) {
  double root = std::max(x, 1.0);
  for (double next = root;; root = next) {
    next = (2.0 * root + x / (root * root)) / 3.0;
    if (!(next < root)) return root;
  }
}

// A sequence of pseudorandom numbers in [0, 1) for one sphere.
class Draws {
 public:
  explicit Draws(int index) : seed_(mix_bits(static_cast<int32_t>(index) + 1)) {}
  double next() { return static_cast<double>(unit_fraction<float>(mix_bits(seed_ ^ wrapping_mul(++drawn_, 0x1b873593)))); }

 private:
  int32_t seed_, drawn_ = 0;
};

struct PlacedParticle {
  glm::dvec3 position;
  glm::vec3 color;
};

// Returns a point at an angle around the y axis, in radians from x to z.
glm::dvec3 on_circle(double angle, double radius, double y) {
  const SinCosDouble a = sincos_radians(angle);
  return {radius * a.cos, y, radius * a.sin};
}

// Returns the i-th of n evenly spaced points in [−1, 1]; 0 if n is 1.
double step(int i, int n) { return n == 1 ? 0.0 : 2.0 * i / (n - 1) - 1.0; }

PlacedParticle on_helix(const ParticlesDescription& p, int i) {
  const double y = 0.5 * p.height * step(i, p.count);
  return {on_circle(p.angle + y, p.orbit_radius, y), glm::vec3(1.0f)};
}

glm::dvec3 turned(const ParticlesDescription& p, const glm::dvec3& at) {
  const SinCosDouble a = sincos_radians(p.angle);
  return {at.x * a.cos - at.z * a.sin, at.y, at.x * a.sin + at.z * a.cos};
}

int rows_for(int count) {
  int n = 1;
  while (n * n * n < count) ++n;
  return n;
}

PlacedParticle in_grid(const ParticlesDescription& p, int rows, int i) {
  const glm::dvec3 at(step(i % rows, rows), step(i / rows % rows, rows), step(i / (rows * rows), rows));
  return {turned(p, at * p.orbit_radius), glm::vec3(0.55 + 0.45 * at)};
}

PlacedParticle in_ball(const ParticlesDescription& p, int i) {
  Draws draws(i);
  glm::dvec3 at;
  do {
    for (int k = 0; k < 3; ++k) at[k] = 2.0 * draws.next() - 1.0;
  } while (glm::dot(at, at) > 1.0);
  const double shade = draws.next();
  return {turned(p, at * p.orbit_radius), glm::vec3(0.6 + 0.4 * shade, 0.75, 1.0 - 0.4 * shade)};
}

PlacedParticle in_galaxy(const ParticlesDescription& p, int i) {
  constexpr double kArms = 3.0, kWound = 0.9, kSpread = 0.1, kThickness = 0.06;
  Draws draws(i);
  const auto middle = [&] { return draws.next() + draws.next() + draws.next() - 1.5; };  // bell-shaped around 0
  const double out = draws.next(), turns = (i % 3) / kArms + kWound * out * out + kSpread * middle();
  const double y = kThickness * p.orbit_radius * middle() * (1.5 - out);
  const auto warm = static_cast<float>(1.0 - out);
  return {on_circle(p.angle + kTurn * turns, p.orbit_radius * out, y),
          glm::vec3(0.5f + 0.5f * warm, 0.65f + 0.15f * warm, 1.0f - 0.5f * warm)};
}

}  // namespace

double particle_radius(const ParticlesDescription& p) {
  if (p.radius > 0.0) return p.radius;
  const double part = p.arrangement == ParticleArrangement::galaxy ? 0.08 : 0.2;
  return part * p.orbit_radius * cube_root(12.0 / std::max(p.count, 1));
}

Particles make_particles(const ParticlesDescription& p) {
  const FloatMode float_mode;
  Particles out;
  const auto count = static_cast<std::size_t>(p.count);
  out.centers_ws.reserve(count);
  out.colors.reserve(count);
  out.radii.assign(count, static_cast<float>(particle_radius(p)));
  const int rows = rows_for(p.count);
  for (int i = 0; i < p.count; ++i) {
    PlacedParticle s{};
    switch (p.arrangement) {
      case ParticleArrangement::helix: s = on_helix(p, i); break;
      case ParticleArrangement::grid: s = in_grid(p, rows, i); break;
      case ParticleArrangement::ball: s = in_ball(p, i); break;
      case ParticleArrangement::galaxy: s = in_galaxy(p, i); break;
    }
    out.centers_ws.push_back(s.position);
    out.colors.push_back(s.color);
  }
  return out;
}

}  // namespace halfspace::HS_LANES
