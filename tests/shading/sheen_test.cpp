// SPDX-License-Identifier: Apache-2.0
//
// Compares sheen with integrals in double precision and with the formulas of the paper.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "halfspace/core/lane_pairs.h"
#include "halfspace/shading/environment/sheen.h"
#include "halfspace/shading/light/ggx.h"
#include "halfspace/shading/surface/metallic_surface.h"

namespace halfspace {

namespace {

// The formulas of Conty Estevez and Kulla, written out for one roughness and double precision.
double log_masking(double x, double alpha) {
  const double t = (1.0 - alpha) * (1.0 - alpha), u = 1.0 - t;
  const double a = 25.3245 * t + 21.5473 * u, b = 3.32435 * t + 3.82987 * u, c = 0.16801 * t + 0.19823 * u;
  const double d = -1.27393 * t - 1.97760 * u, e = -4.85967 * t - 4.32054 * u;
  return a / (1.0 + b * std::pow(x, c)) + d * x + e;
}
double masking(double cosine, double alpha) {
  if (cosine < 0.5) return std::exp(log_masking(cosine, alpha));
  return std::exp(2.0 * log_masking(0.5, alpha) - log_masking(1.0 - cosine, alpha));
}
double sheen(double roughness, double sine_h, double n_l, double n_v) {
  const double alpha = roughness * roughness, inverse = 1.0 / alpha;
  const double distribution = (2.0 + inverse) * std::pow(sine_h, inverse) / (2.0 * std::numbers::pi);
  return std::numbers::pi * distribution * n_l / ((1.0 + masking(n_v, alpha) + masking(n_l, alpha)) * 4.0 * n_v * n_l);
}

// The relative tolerance allows for the coefficients in single precision: a change of 3e-8 of `a`, about 25, changes log Λ by up to 1e-6.
TEST(Sheen, MatchesTheFormulasOfThePaper) {
  for (const double roughness : {0.05, 0.2, 0.5, 1.0}) {
    for (const double n_v : {0.01, 0.3, 0.5, 0.51, 1.0}) {
      for (const double n_l : {0.02, 0.4, 0.97, 1.0}) {
        for (const double sine_h : {0.2, 0.9, 1.0}) {
          const double expected = sheen(roughness, sine_h, n_l, n_v);
          EXPECT_NEAR(sheen_reflection(roughness, sine_h, n_l, n_v), expected, 1e-5 * expected) << roughness << ' ' << n_v << ' ' << n_l;
          // Single precision: unit_pow has an absolute error of 6e-7, and the rounding of 1/α is multiplied by log(sin θ).
          const double bound = (2.0 + 1.0 / (roughness * roughness)) / (8.0 * n_v);
          const float single =
              sheen_reflection(static_cast<float>(roughness), static_cast<float>(sine_h), static_cast<float>(n_l), static_cast<float>(n_v));
          EXPECT_NEAR(single, expected, 2e-5 * expected + 2e-6 * bound) << roughness << ' ' << n_v << ' ' << n_l;
        }
      }
    }
  }
}

// The dot product of two unit vectors can exceed 1 by rounding.
TEST(Sheen, AcceptsCosinesAboveOne) {
  const float above = std::nextafter(1.0f, 2.0f);
  EXPECT_NEAR(sheen_reflection(0.5f, 0.5f, above, above), sheen_reflection(0.5f, 0.5f, 1.0f, 1.0f), 1e-6f);
  EXPECT_NEAR(sheen_reflection(0.5, 0.5, 1.0 + 1e-15, 1.0 + 1e-15), sheen_reflection(0.5, 0.5, 1.0, 1.0), 1e-14);
}

// The reference integrates over 300 × 300 directions; the table has 64 × 32 entries. The bound is that of the documentation: linear
// interpolation between entries is too high where the integral falls steeply, at grazing views of smooth sheen.
TEST(Sheen, DirectionalSheenMatchesTheIntegral) {
  constexpr int kSteps = 300;
  double largest = 0.0;
  for (const double roughness : {0.0, 0.06, 0.1, 0.25, 0.5, 0.75, 1.0}) {
    for (const double n_v : {0.1, 0.125, 0.15, 0.3, 0.6, 0.99}) {
      const glm::dvec3 v(std::sqrt(1.0 - n_v * n_v), 0.0, n_v);
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double n_l = (i + 0.5) / kSteps, radius = std::sqrt(1.0 - n_l * n_l);
        for (int j = 0; j < kSteps; ++j) {
          const double azimuth = std::numbers::pi * (j + 0.5) / kSteps;
          const glm::dvec3 h = glm::normalize(v + glm::dvec3(radius * std::cos(azimuth), radius * std::sin(azimuth), n_l));
          sum += sheen(std::max(roughness, double{kMinRoughness}), std::hypot(h.x, h.y), n_l, n_v);
        }
      }
      const double expected = std::min(2.0 * sum / (kSteps * kSteps), 1.0);
      const double error = std::fabs(directional_sheen(roughness, n_v) - expected);
      EXPECT_LT(error, 0.02) << "roughness " << roughness << ", n·v " << n_v << ", expected " << expected;
      largest = std::max(largest, error);
    }
  }
  std::printf("largest error of the table %.4f\n", largest);
}

// A surface with sheen under a light that casts no shadow reflects part of what the surface without sheen reflects, and the light itself.
TEST(Sheen, ReflectsALight) {
  using Surface = MetallicSurface<MetallicStreams::basic>;
  const glm::vec3 l = glm::normalize(glm::vec3(-0.8f, 0.3f, 0.4f)), v = glm::normalize(glm::vec3(-0.7f, 0.3f, 0.2f));
  const std::array<Light, 1> lights{{{.position_rws = l, .diffuse = {0.9f, 0.8f, 0.7f}, .specular = {0.3f, 0.6f, 0.9f}}}};
  Surface cloth{};
  cloth.base_color = {0.2f, 0.1f, 0.4f, 1.0f};
  cloth.roughness = 0.8f;
  cloth.emissive = {0.05f, 0.0f, 0.0f};
  cloth.sheen = 0.8f;
  cloth.sheen_color = {1.0f, 0.5f, 0.25f};
  cloth.sheen_roughness = 0.4f;
  cloth.lights = lights;
  cloth.to_eye_ws = v;
  Surface bare = cloth;
  bare.sheen = 0.0f;
  Surface::Varyings<float> in{};
  in.normal_ws = vec3<float>(0, 1, 0);
  const Pixel<float> px{};
  const glm::vec4 with(cloth.fragment(in, px).color), without(bare.fragment(in, px).color);
  const glm::vec3 h = glm::normalize(l + v);
  const float lobe = sheen_reflection(0.4f, std::sqrt(1.0f - h.y * h.y), l.y, v.y), through = 1.0f - 0.8f * directional_sheen(0.4f, v.y);
  for (int k = 0; k < 3; ++k) {
    const float reflected = 0.8f * cloth.sheen_color[k] * lights[0].specular[k] * lobe;
    EXPECT_NEAR(with[k], without[k] * through + reflected, 1e-6f);  // a few roundings of values below 1
    EXPECT_GT(reflected, 0.01f);
  }
}

// Checks with_sheen for points with different normals, one per lane, against its result for each point.
template <class R>
void expect_scalar_sheen() {
  const std::array<Light, 1> lights{{{.type = LightType::point, .position_rws = {1.0f, 3.0f, 0.5f}}}};
  const auto normal = [](int k) { return glm::normalize(glm::vec3(0.1f * static_cast<float>(k) - 0.7f, 1.0f, 0.3f)); };
  SurfacePoint<R> p{};
  p.v_ws = vec3<R>(R(0.6f), R(0.8f), R(0));
  for (int k = 0; k < kWidthOf<R>; ++k) {
    set_lane(p.n_ws.x, k, normal(k).x);
    set_lane(p.n_ws.y, k, normal(k).y);
    set_lane(p.n_ws.z, k, normal(k).z);
  }
  const vec3<R> lanes = with_sheen(vec3<R>(R(0.5f)), SheenLayer<R>{vec3<R>(R(0.7f)), R(0.5f)}, p, lights, vec3<R>(R(0.25f)));
  for (int k = 0; k < kWidthOf<R>; ++k) {
    SurfacePoint<float> one{};
    one.v_ws = vec3<float>(0.6f, 0.8f, 0.0f);
    one.n_ws = vec3<float>(normal(k));
    const SheenLayer<float> layer{vec3<float>(0.7f), 0.5f};
    EXPECT_EQ(lane(lanes.x, k), with_sheen(vec3<float>(0.5f), layer, one, lights, vec3<float>(0.25f)).x);
  }
}

TEST(Sheen, SurfacesInLanesMatchScalarBits) {
  expect_scalar_sheen<Real>();
  expect_scalar_sheen<FragmentReal>();
}

TEST(Sheen, LanesMatchScalarBits) {
  for (int i = 0; i < 64; i += kLanes) {
    const Real x = (to_real<Real>(iota<IntOf<Real>>() + IntOf<Real>(i)) + Real(0.5f)) * Real(1.0f / 64.0f);
    const Real lobe = sheen_reflection(x, Real(0.9f), Real(1.0f) - x, x), total = directional_sheen(Real(0.4f), x);
    for (int k = 0; k < kLanes; ++k) {
      const float s = lane(x, k);
      EXPECT_EQ(lane(lobe, k), sheen_reflection(s, 0.9f, 1.0f - s, s));
      EXPECT_EQ(lane(total, k), directional_sheen(0.4f, s));
    }
  }
}

}  // namespace

}  // namespace halfspace
