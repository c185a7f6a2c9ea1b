// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/environment/reflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/random.h"

namespace halfspace {
namespace {

TEST(Reflection, FollowsTheLawOfReflection) {
  const Differential<double> d{{1, -1, 0}, {}, {}}, n{{0, 1, 0}, {}, {}};
  EXPECT_EQ(reflected(d, n).at, glm::dvec3(1, 1, 0));
  const Differential<double> back{{0, -1, 0}, {}, {}};
  EXPECT_EQ(reflected(back, n).at, glm::dvec3(0, 1, 0));
  EXPECT_EQ(reflected(back, {{0, -1, 0}, {}, {}}).at, glm::dvec3(0, 1, 0)) << "the sign of the normal does not matter";
}

// Compares the analytic derivatives with finite differences, for a normal and a ray that both rotate.
TEST(Reflection, DerivativesMatchFiniteDifferences) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Differential<double> eye{random_vector(random), random_vector(random), random_vector(random)};
    const Differential<double> normal{random_vector(random), random_vector(random), random_vector(random)};
    const double h = 1e-6;
    const auto ray = [&](double x, double y) {
      const glm::dvec3 d = eye.at + eye.dx * x + eye.dy * y, n = normalize(normal.at + normal.dx * x + normal.dy * y);
      return d - n * (2 * glm::dot(d, n));
    };
    const Differential<double> got = reflected(eye, normalized(normal));
    const double scale = (1 + length(normal.dx) + length(normal.dy)) / length(normal.at);
    // The error of a central difference is proportional to h²·f''', and f''' grows with the cube of the normal's rotation rate.
    const double tolerance = 1e-7 + 1e-9 * scale * scale * scale;
    EXPECT_LT(length(got.at - ray(0, 0)), 1e-12);
    EXPECT_LT(length(got.dx - (ray(h, 0) - ray(-h, 0)) / (2 * h)), tolerance * length(eye.at) + tolerance * length(eye.dx));
    EXPECT_LT(length(got.dy - (ray(0, h) - ray(0, -h)) / (2 * h)), tolerance * length(eye.at) + tolerance * length(eye.dy));
  }
}

// A flat mirror shows the sky at the same mip level as a camera behind the mirror would. A ball of radius r at distance a minifies the sky
// by 1 + 2a/r at its center.
TEST(Reflection, LevelMatchesTheReflectedImage) {
  Image<glm::vec4> image(256, 128);
  const EnvironmentMap map(image, TexelFormat::rgba16f);
  const double pixel = 1e-3, distance = 5.0, radius = 0.5;
  const Differential<double> d{{0, 0, -distance}, {pixel * distance, 0, 0}, {0, pixel * distance, 0}};
  const double direct = map.level_of_detail<double>(d.at, d.dx, d.dy);
  const Differential<double> flat = reflected(d, {{0, 0, 1}, {}, {}});
  EXPECT_NEAR(map.level_of_detail<double>(flat.at, flat.dx, flat.dy), direct, 1e-12);
  const Differential<double> ball = reflected(d, normalized<double>({{0, 0, radius}, {pixel * distance, 0, 0}, {0, pixel * distance, 0}}));
  EXPECT_NEAR(map.level_of_detail<double>(ball.at, ball.dx, ball.dy), direct + std::log2(1 + 2 * distance / radius), 1e-9);
}

TEST(Reflection, ReturnsTheLightFromTheReflectedDirection) {
  Image<glm::vec4> image(4, 2);
  for (int x = 0; x < 4; ++x) image.at(x, 0) = image.at(x, 1) = glm::vec4(static_cast<float>(x));
  const EnvironmentMap map(image, TexelFormat::rgba32f);
  const EnvironmentBlend sky{.first = {.map = &map}, .second = {}, .weight = 0};
  // A diagonal mirror reflects the view ray, which looks along -z, to -x. That direction is between columns 0 and 1.
  const Differential<float> d{{0, 0, -1}, {}, {}}, n{{-std::sqrt(0.5f), 0, std::sqrt(0.5f)}, {}, {}};
  EXPECT_NEAR(environment_reflection(sky, d, n).x, 0.5f, 1e-5f);
}

}  // namespace
}  // namespace halfspace
