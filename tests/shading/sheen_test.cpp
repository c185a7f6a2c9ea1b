// SPDX-License-Identifier: Apache-2.0
//
// Compares sheen with integrals in double precision and with the formulas of the paper.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "halfspace/core/lanes.h"
#include "halfspace/shading/sheen.h"

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
      for (const double n_l : {0.02, 0.4, 0.97}) {
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

// The reference integrates over 300 × 300 directions; the table has 32 × 32 entries.
TEST(Sheen, DirectionalSheenMatchesTheIntegral) {
  constexpr int kSteps = 300;
  double largest = 0.0;
  for (const double roughness : {0.1, 0.25, 0.5, 0.75, 1.0}) {
    for (const double n_v : {0.1, 0.15, 0.3, 0.6, 0.99}) {
      const glm::dvec3 v(std::sqrt(1.0 - n_v * n_v), 0.0, n_v);
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double n_l = (i + 0.5) / kSteps, radius = std::sqrt(1.0 - n_l * n_l);
        for (int j = 0; j < kSteps; ++j) {
          const double azimuth = std::numbers::pi * (j + 0.5) / kSteps;
          const glm::dvec3 h = glm::normalize(v + glm::dvec3(radius * std::cos(azimuth), radius * std::sin(azimuth), n_l));
          sum += sheen(roughness, std::hypot(h.x, h.y), n_l, n_v);
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
