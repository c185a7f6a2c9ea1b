// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/environment/star_sky.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace halfspace {
namespace {

// Returns the i-th of n directions that are evenly distributed over the sphere (golden spiral).
glm::vec3 direction(int i, int n) {
  const double z = 1.0 - (2.0 * i + 1.0) / n, r = std::sqrt(1.0 - z * z), turn = 2.399963229728653 * i;
  return {static_cast<float>(r * std::cos(turn)), static_cast<float>(r * std::sin(turn)), static_cast<float>(z)};
}

TEST(StarSky, LanesMatchScalarBits) {
  const StarSky sky{.pixel = 4e-3f};
  constexpr int kCount = 4096 * kLanes;
  int lit = 0;
  for (int i = 0; i < kCount; i += kLanes) {
    vec3<Real> d(Real(0.0f), Real(0.0f), Real(0.0f));
    for (int k = 0; k < kLanes; ++k) {
      const glm::vec3 one = direction(i + k, kCount);
      for (int c = 0; c < 3; ++c) set_lane(d[c], k, one[c]);
    }
    const vec3<Real> light = sky.star_light(d);
    for (int k = 0; k < kLanes; ++k) {
      const vec3<float> want = sky.star_light<float>(direction(i + k, kCount));
      for (int c = 0; c < 3; ++c) ASSERT_EQ(lane(light[c], k), want[c]) << i + k;
      lit += want.x > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 0);
}

TEST(StarSky, DensityIsTheFractionOfCellsWithAStar) {
  // The disk of a cell covers π·(1.3·pixel)² on the face, multiplied by a factor that decreases toward the corners. `mean` is
  // the average of this factor, 1/√(1 + a² + b²).
  double mean = 0.0;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) mean += 1e-4 / std::sqrt(1.0 + std::pow((i + 0.5) / 100, 2) + std::pow((j + 0.5) / 100, 2));
  }
  const float pixel = 2e-3f;
  for (const float density : {0.0f, 0.25f, 1.0f}) {
    const StarSky sky{.density = density, .pixel = pixel};
    constexpr int kCount = 1 << 20;
    int lit = 0;
    for (int i = 0; i < kCount; ++i) lit += sky.star_light<float>(direction(i, kCount)).x > 0 ? 1 : 0;
    const double want = mean * static_cast<double>(density) * 24576.0 * std::pow(1.3 * static_cast<double>(pixel), 2) / 4.0 * kCount;
    // If a quarter of the 24576 cells have a star, the standard deviation of the number of stars is √(24576·3/16) = 68, or 1.1%. The
    // randomness of about 9000 hits adds another 1.1%. The tolerance is four standard deviations of both.
    EXPECT_NEAR(lit, want, 0.06 * want);
  }
}

TEST(StarSky, NoStarExceedsTheBrightness) {
  const StarSky sky{.brightness = 2.0f, .density = 1.0f, .pixel = 1e-2f};
  float brightest = 0;
  for (int i = 0; i < 1 << 18; ++i) {
    const vec3<float> c = sky.star_light<float>(direction(i, 1 << 18));
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(c[k], 0.0f);
      brightest = std::max(brightest, c[k]);
    }
  }
  EXPECT_LE(brightest, 2.0f);
  EXPECT_GT(brightest, 1.0f);
}

TEST(StarSky, DirectionsOnFaceEdgesGiveFiniteValues) {
  const StarSky sky{.density = 1.0f, .pixel = 1e-2f};
  for (const float x : {-1.0f, 0.0f, 1.0f}) {
    for (const float y : {-1.0f, 0.0f, 1.0f}) {
      for (const float z : {-1.0f, 0.0f, 1.0f}) {
        if (x == 0 && y == 0 && z == 0) continue;
        const vec3<float> c = sky.star_light<float>(glm::normalize(glm::vec3(x, y, z)));
        EXPECT_TRUE(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z));
      }
    }
  }
}

}  // namespace
}  // namespace halfspace
