// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "halfspace/core/trig_double.h"
#include "scenes/garden_parts.h"
#include "workloads/workload_random.h"

namespace halfspace::garden {

namespace {

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double wave(double turns) { return sincos_turns(turns).sin; }

// Maps [0, 1] to a coordinate; vertices are denser in the middle.
double spread(double u) {
  const double t = 2 * u - 1;
  return 110.0 * t * (0.25 + 0.75 * t * t);
}

// Adds two crossed cards that stand on the ground. They have the normals of the ground.
void add_tuft(SceneShape& shape, glm::dvec3 at, double height, WorkloadRandom& random) {
  const double turn = random.unit(), size = height * random.between(0.6, 1.15);
  for (const double quarter : {0.0, 0.25}) {
    const SinCosDouble a = sincos_turns(turn + quarter);
    const glm::dvec3 lean{0.15 * a.sin, 1.0, -0.15 * a.cos};
    add_card(shape, at + 0.48 * size * lean, 0.55 * size * glm::dvec3(a.cos, 0, a.sin), 0.5 * size * lean, {0, 1, 0});
  }
}

}  // namespace

double ground_height(double x, double z) {
  const double r = std::sqrt(x * x + z * z);
  double y = 0.22 * wave(0.045 * x + 0.02 * z) + 0.18 * wave(0.06 * z - 0.03 * x + 0.3) + 0.05 * wave(0.21 * x + 0.13 * z);
  y += smooth(22, 90, r) * (9.0 + 4.0 * wave(0.013 * x - 0.009 * z) + 2.5 * wave(0.031 * z + 0.011 * x));
  y = glm::mix(y, 0.0, smooth(6.0, 3.5, glm::length(glm::dvec2(x, z) - kPavilion)));
  y = glm::mix(y, 0.0, smooth(7.5, 4.5, glm::length(glm::dvec2(x, z) - kGreenhouse)));
  const double to_pond = glm::length(glm::dvec2(x, z) - kPond) + 0.6 * wave(0.12 * x + 0.3) + 0.5 * wave(0.17 * z);
  return glm::mix(y, -1.1, smooth(kPondRadius + 1.8, kPondRadius - 2.5, to_pond));
}

glm::dvec2 path_at(double v) {
  const double z = 26.0 - 36.0 * v;
  return {3.2 + 2.4 * wave(0.035 * z + 0.1) - 12.5 * smooth(0.78, 1.02, v), z};
}

bool is_free(double x, double z, double margin) {
  const glm::dvec2 at(x, z), house = glm::abs(at - kGreenhouse);
  if (glm::length(at - kPond) < kPondRadius + 1.0 + margin || glm::length(at - kPavilion) < kPavilionRadius + 0.8 + margin) return false;
  if (house.x < 0.5 * kHouseSize.x + 0.4 + margin && house.y < 0.5 * kHouseSize.z + 0.4 + margin) return false;
  for (int i = 0; i <= 40; ++i) {
    if (glm::length(at - path_at(i / 40.0)) < 1.1 + margin) return false;
  }
  return true;
}

SceneShape terrain() {
  SceneShape shape;
  add_surface(shape, 180, 180, {1, 1}, [](double u, double v) { return on_ground(spread(u), -spread(v)); });
  for (SceneVertex& v : shape.vertices) v.uv = 0.3f * glm::vec2(v.position.x, v.position.z);
  return shape;
}

SceneShape path() {
  SceneShape shape;
  add_surface(shape, 8, 160, {1, 20}, [](double u, double v) {
    const glm::dvec2 d = path_at(v + 1e-3) - path_at(v - 1e-3), side = glm::normalize(glm::dvec2(-d.y, d.x));
    const glm::dvec2 at = path_at(v) + side * (1.8 * (u - 0.5));
    const double edge = 2 * u - 1;
    return on_ground(at.x, at.y, 0.06 - 0.08 * edge * edge * edge * edge);
  });
  return shape;
}

SceneShape water() {
  SceneShape shape;
  constexpr double kSize = 2 * kPondRadius + 5.0;
  add_surface(shape, 72, 72, {5, 5}, [](double u, double v) {
    const double x = kPond.x + kSize * (u - 0.5), z = kPond.y + kSize * (0.5 - v);
    return glm::dvec3(x, kWater + 0.012 * wave(0.35 * x + 0.2 * z) + 0.009 * wave(0.5 * z - 0.3 * x) + 0.006 * wave(0.8 * x + 0.9 * z), z);
  });
  return shape;
}

SceneShape stone(uint32_t seed) {
  SceneShape shape;
  WorkloadRandom random(seed);
  const double a = random.unit(), b = random.unit(), c = random.unit();
  add_surface(shape, 28, 18, {2, 1}, [=](double u, double v) {
    const SinCosDouble around = sincos_turns(u), up = sincos_turns(0.5 * v - 0.25);
    const glm::dvec3 d(up.cos * around.cos, up.sin, -up.cos * around.sin);
    const double r =
        1.0 + 0.16 * wave(0.33 * d.x + 0.4 * d.y + a) + 0.12 * wave(0.6 * d.z - 0.3 * d.x + b) + 0.07 * wave(1.1 * d.y + 0.9 * d.z + c);
    return r * d * glm::dvec3(1.0, 0.62, 0.85);
  });
  return shape;
}

SceneShape patch(const PatchOptions& o) {
  SceneShape shape;
  WorkloadRandom random(o.seed);
  for (int i = 0; i < o.count; ++i) {
    const glm::dvec2 at = o.center + o.size * glm::dvec2{random.between(-0.5, 0.5), random.between(-0.5, 0.5)};
    if (is_free(at.x, at.y, 0.0)) add_tuft(shape, on_ground(at.x, at.y), o.height, random);
  }
  return shape;
}

SceneShape reeds(int count, double height, uint32_t seed) {
  SceneShape shape;
  WorkloadRandom random(seed);
  while (shape.indices.size() < 12 * static_cast<std::size_t>(count)) {
    const double turn = random.unit(), r = kPondRadius * random.between(0.7, 1.25);
    if (wave(3 * turn + 0.1) < -0.2) continue;  // leave gaps
    const SinCosDouble a = sincos_turns(turn);
    const glm::dvec3 at = on_ground(kPond.x + r * a.cos, kPond.y + r * a.sin);
    if (at.y > kWater - 0.35 && at.y < kWater + 0.12) add_tuft(shape, at, height, random);
  }
  return shape;
}

SceneShape lily_pads(int count, uint32_t seed) {
  SceneShape shape;
  WorkloadRandom random(seed);
  for (int i = 0; i < count; ++i) {
    const SinCosDouble a = sincos_turns(0.55 + random.between(-0.16, 0.16));
    const double r = kPondRadius * random.between(0.25, 0.75), size = random.between(0.16, 0.34), turn = random.unit();
    SceneShape pad;
    add_surface(pad, 20, 3, {1, 1}, [=](double u, double v) {
      const SinCosDouble b = sincos_turns(0.93 * u);
      return size * (1 - v) * glm::dvec3(b.cos, 0.1 * (1 - v), -b.sin);
    });
    add_shape(shape, pad, placed({kPond.x + r * a.cos, kWater + 0.03, kPond.y + r * a.sin}, turn));
  }
  return shape;
}

}  // namespace halfspace::garden
