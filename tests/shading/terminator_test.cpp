// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/shadow/terminator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace halfspace {
namespace {

using Vec = vec3<double>;

// The interpolated normal of a triangle and its changes along two directions of the triangle's plane.
struct Sample {
  Vec n, n_x, n_y, p_x, p_y;
};
Sample sample_of(const std::array<Vec, 3>& p, const std::array<Vec, 3>& n, const std::array<double, 3>& w) {
  // Oblique directions, as of a triangle seen at an angle.
  const Vec e1 = p[1] - p[0], e2 = p[2] - p[0], m1 = n[1] - n[0], m2 = n[2] - n[0];
  return {n[0] * w[0] + n[1] * w[1] + n[2] * w[2], m1 * 0.01 + m2 * 0.004, m1 * 0.002 - m2 * 0.003, e1 * 0.01 + e2 * 0.004,
          e1 * 0.002 - e2 * 0.003};
}
double height_of(const Sample& s) { return smooth_height<double>(s.n, s.n_x, s.n_y, s.p_x, s.p_y); }

// A point of a cylinder of radius 2 around the y axis.
Vec normal_at(double angle) { return {std::sin(angle), 0.0, std::cos(angle)}; }

TEST(SmoothHeight, IsTheDistanceFromAChordToItsCircle) {
  for (const double half : {0.01, 0.05, 0.13}) {  // 0.13: a ball of 24 sectors
    const std::array<Vec, 3> n{normal_at(-half), normal_at(half), normal_at(half)};
    const std::array<Vec, 3> p{n[0] * 2.0, n[1] * 2.0, n[2] * 2.0 + Vec(0.0, 0.7, 0.0)};
    const double sagitta = 2.0 * (1.0 - std::cos(half));
    // The parabola through the ends with their slopes differs from the circle by the fourth power of the angle.
    EXPECT_NEAR(smooth_height<double>(p, n, {0.5, 0.5, 0.0}), sagitta, 0.3 * half * half * sagitta);
    EXPECT_NEAR(height_of(sample_of(p, n, {0.5, 0.5, 0.0})), sagitta, 0.3 * half * half * sagitta + 1e-5);
    EXPECT_EQ(smooth_height<double>(p, n, {1.0, 0.0, 0.0}), 0.0);
  }
}

TEST(SmoothHeight, AgreesWithTheVerticesOnASphere) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-0.15, 0.15), weight(0.05, 1.0);
  for (int i = 0; i < 200; ++i) {
    std::array<Vec, 3> n, p;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = any(random), y = any(random);
      n[k] = Vec(x, y, std::sqrt(1.0 - x * x - y * y));
      p[k] = n[k] * 3.0;
    }
    std::array<double, 3> w{weight(random), weight(random), weight(random)};
    const double sum = w[0] + w[1] + w[2];
    for (double& x : w) x /= sum;
    // Rounding of the normals is ignored up to 2^-20 of the squared length, half of which is multiplied by the radius.
    EXPECT_NEAR(height_of(sample_of(p, n, w)), smooth_height<double>(p, n, w), 3.0 * 0x1p-21 + 1e-12);
  }
}

TEST(SmoothHeight, IsZeroWhereTheSurfaceIsFlatOrBelowTheTriangle) {
  const std::array<Vec, 3> p{Vec(0.0, 0.0, 0.0), Vec(1.0, 0.0, 0.0), Vec(0.0, 1.0, 0.0)};
  const std::array<double, 3> middle{0.4, 0.3, 0.3};
  const std::array<Vec, 3> flat{Vec(0.0, 0.0, 1.0), Vec(0.0, 0.0, 1.0), Vec(0.0, 0.0, 1.0)};
  EXPECT_EQ(height_of(sample_of(p, flat, middle)), 0.0);
  std::array<Vec, 3> rounded = flat;
  rounded[1].x = 0x1p-24;
  EXPECT_EQ(height_of(sample_of(p, rounded, middle)), 0.0);
  const std::array<Vec, 3> bowl{normal_at(0.1), normal_at(-0.1), normal_at(0.1)};
  EXPECT_EQ(height_of(sample_of(p, bowl, middle)), 0.0);
  EXPECT_EQ(smooth_height<double>(p, bowl, middle), 0.0);
}

TEST(TerminatorFraction, FadesWithTheRatioOfTheCosines) {
  EXPECT_EQ(terminator_fraction(0.3f, 0.3f), 1.0f);  // no normal map: exactly 1
  EXPECT_EQ(terminator_fraction(1e-4f, 1e-4f), 1.0f);
  EXPECT_EQ(terminator_fraction(0.1f, 0.4f), 1.0f);
  EXPECT_FLOAT_EQ(terminator_fraction(0.05f, 0.4f), 0.5f);
  EXPECT_EQ(terminator_fraction(0.0f, 0.4f), 0.0f);
  EXPECT_EQ(terminator_fraction(-0.2f, 0.4f), 0.0f);
  EXPECT_EQ(terminator_fraction(0.0f, 0.0f), 0.0f);
  float before = 0.0f;
  for (int i = 0; i <= 100; ++i) {
    const float now = terminator_fraction(0.002f * static_cast<float>(i), 0.8f);
    EXPECT_GE(now, before);
    EXPECT_LE(now - before, 0.016f);  // 1.5 times the mean slope; no step
    before = now;
  }
}

}  // namespace
}  // namespace halfspace
