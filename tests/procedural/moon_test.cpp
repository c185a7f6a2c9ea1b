// SPDX-License-Identifier: Apache-2.0
#include "halfspace/procedural/moon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "halfspace/procedural/craters.h"
#include "support/expected_hash.h"
#include "support/hash.h"
#include "support/test_output.h"

namespace halfspace {
namespace {

uint64_t hash_of(const MoonMaps& maps) {
  Hash hash;
  hash.add_codes(maps.color);
  for (const uint16_t h : maps.height.texels()) hash.add(h);
  return hash.value();
}

double km(uint16_t code) { return code * 20.0 / 65535.0 - 10.0; }

const MoonMaps& moon_512() {
  static const MoonMaps maps = procedural_moon(512, Workers(2));
  return maps;
}

// The maps are bit-identical for every compiler, SIMD width and processor.
TEST(ProceduralMoon, MatchesTheStoredHash) {
  EXPECT_TRUE(expect_hash("moon", hash_of(moon_512()))) << write_failed_picture("moon", moon_512().color, {});
}

TEST(ProceduralMoon, IsBitIdenticalForAnyThreadCount) {
  const MoonMaps one = procedural_moon(202, Workers(1)), many = procedural_moon(202, Workers(7));
  EXPECT_TRUE(one.color == many.color);
  EXPECT_TRUE(one.height == many.height);
}

TEST(ProceduralMoon, FillsImagesOfAnySize) {
  for (const int width : {2, 6, 38}) {
    const MoonMaps maps = procedural_moon(width, Workers(1));
    ASSERT_EQ(maps.color.width(), width);
    ASSERT_EQ(maps.color.height(), width / 2);
    ASSERT_EQ(maps.height.width(), width);
    ASSERT_EQ(maps.height.height(), width / 2);
    for (const glm::u8vec4& t : maps.color.texels()) {
      EXPECT_EQ(t.w, 255);
      EXPECT_GT(t.x, 30);
    }
  }
  EXPECT_DEATH(procedural_moon(3, Workers(1)), "width is odd");
}

// The heights of the real Moon range from −9.1 to 10.8 km. Means and fractions are weighted by area, which is proportional to sin πv.
TEST(ProceduralMoon, HasPlausibleStatistics) {
  const MoonMaps& maps = moon_512();
  double area = 0, height = 0, square = 0, dark = 0, dark_near = 0, luminance = 0;
  uint16_t lowest = 65535, highest = 0;
  for (int y = 0; y < 256; ++y) {
    const double weight = std::sin(std::numbers::pi * (y + 0.5) / 256);
    for (int x = 0; x < 512; ++x) {
      const uint16_t code = maps.height.at(x, y);
      lowest = std::min(lowest, code);
      highest = std::max(highest, code);
      const bool is_sea = maps.color.at(x, y).y < 115;
      area += weight;
      height += weight * km(code);
      square += weight * km(code) * km(code);
      luminance += weight * maps.color.at(x, y).y;
      dark += is_sea ? weight : 0;
      dark_near += is_sea && x >= 128 && x < 384 ? weight : 0;
    }
  }
  const double mean = height / area;
  EXPECT_NEAR(mean, 0.0, 0.6);
  EXPECT_NEAR(std::sqrt(square / area - mean * mean), 1.6, 0.6);
  EXPECT_GT(km(lowest), -9.5);
  EXPECT_LT(km(lowest), -3.5);
  EXPECT_GT(km(highest), 2.5);
  EXPECT_LT(km(highest), 9.5);
  EXPECT_NEAR(luminance / area, 145, 12);
  EXPECT_NEAR(dark / area, 0.17, 0.06);
  EXPECT_GT(dark_near, 0.8 * dark) << "most maria are on the near side";
}

// Returns the mean difference between the heights of two columns, in km.
double column_difference(const MoonMaps& maps, int a, int b) {
  double sum = 0;
  for (int y = 0; y < maps.height.height(); ++y) sum += std::fabs(km(maps.height.at(a, y)) - km(maps.height.at(b, y)));
  return sum / maps.height.height();
}

// The left and right edges are adjacent on the sphere, so they must not differ more than adjacent columns do elsewhere.
TEST(ProceduralMoon, HasNoSeam) {
  double elsewhere = 0;
  for (int x = 0; x + 1 < 512; ++x) elsewhere = std::max(elsewhere, column_difference(moon_512(), x, x + 1));
  EXPECT_LE(column_difference(moon_512(), 511, 0), elsewhere);
}

// In the row half a texel from a pole, adjacent texels are a small fraction of a texel apart on the sphere.
TEST(ProceduralMoon, PolesAreNotPinched) {
  const MoonMaps maps = procedural_moon(1024, Workers(2));
  for (const int row : {0, 511}) {
    for (int x = 0; x < 1024; ++x) {
      EXPECT_NEAR(km(maps.height.at(x, row)), km(maps.height.at((x + 1) % 1024, row)), 0.02);
      EXPECT_NEAR(maps.color.at(x, row).y, maps.color.at((x + 1) % 1024, row).y, 3);
    }
  }
}

// ---- craters ---------------------------------------------------------------------------------------------------

using namespace procedural;

CraterRow row_at(double pi_v, int width) {
  CraterRow row{width, static_cast<float>(std::cos(pi_v)), static_cast<float>(std::sin(pi_v)), {}, {}, {}, {}};
  for (auto* v : {&row.x, &row.z, &row.relief, &row.light}) v->resize(static_cast<std::size_t>(width + kLanes));
  for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(x) + 0.5) / width;
    row.x[x] = static_cast<float>(std::sin(pi_v) * std::cos(angle));
    row.z[x] = static_cast<float>(-std::sin(pi_v) * std::sin(angle));
  }
  return row;
}

// The number of craters larger than r is proportional to r^-2, so halving the radius gives four times as many.
TEST(MoonCraters, SizesFollowAPowerLaw) {
  const Craters craters = moon_craters(2048);
  const auto larger_than = [&](float r) {
    return static_cast<double>(std::count_if(craters.all.begin(), craters.all.end(), [&](const Crater& c) { return c.radius > r; }));
  };
  EXPECT_GT(craters.all.size(), 20000u);
  EXPECT_LT(craters.first_young, craters.all.size());
  EXPECT_GT(craters.first_young, craters.all.size() * 8 / 10);
  EXPECT_NEAR(larger_than(0.006f) / larger_than(0.012f), 4.0, 0.4);
  EXPECT_NEAR(larger_than(0.012f) / larger_than(0.024f), 4.0, 0.8);
}

// Without wobble, a crater has the same profile everywhere: the relief depends only on the distance on the sphere, even where the crater
// crosses the seam or a pole. Distances on the unit sphere have a float error of 1e-7; heights change by up to 4 km per 0.02.
TEST(MoonCraters, AreRoundOnTheSphere) {
  Crater crater = moon_craters(2048).all.back();
  std::fill(std::begin(crater.wobble), std::end(crater.wobble), 0.0f);
  for (const double colatitude : {0.0, 0.02, 0.3, 1.5, 3.13}) {
    const double s = std::sin(colatitude), c = std::cos(colatitude);
    crater.center = glm::vec3(glm::dvec3(s, c, 0));  // on the seam
    crater.east = glm::vec3(0, 0, -1);
    crater.north = glm::vec3(glm::dvec3(-c, s, 0));
    std::vector<std::pair<double, double>> reliefs;  // distance, height in km
    for (double pi_v = 0.001; pi_v < std::numbers::pi; pi_v += 0.002) {
      CraterRow row = row_at(pi_v, 512);
      stamp(crater, row);
      for (std::size_t x = 0; x < 512; ++x) {
        const glm::dvec3 p(row.x[x], row.y, row.z[x]);
        const double distance = glm::length(p - glm::dvec3(crater.center));
        if (distance < 2.5 * static_cast<double>(crater.radius)) {
          reliefs.emplace_back(distance, row.relief[x]);
        } else {
          EXPECT_EQ(row.relief[x], 0.0f);
        }
      }
    }
    ASSERT_GT(reliefs.size(), 100u);
    std::sort(reliefs.begin(), reliefs.end());
    EXPECT_LT(reliefs.front().second, 0.0);
    const double steepest = 4.0 * static_cast<double>(crater.depth + crater.rim) / static_cast<double>(crater.radius);
    for (std::size_t i = 1; i < reliefs.size(); ++i) {
      EXPECT_LE(std::fabs(reliefs[i].second - reliefs[i - 1].second), steepest * (reliefs[i].first - reliefs[i - 1].first) + 1e-3);
    }
  }
}

TEST(MoonCraters, HaveValidProfilesAndRowRanges) {
  for (const Crater& crater : moon_craters(1024).all) {
    EXPECT_GT(crater.depth, 0.0f);
    EXPECT_GT(crater.rim, 0.0f);
    EXPECT_LT(crater.depth + crater.rim, 6.5f);
    EXPECT_LT(crater.peak, crater.depth);
    EXPECT_NEAR(glm::length(crater.center), 1.0f, 1e-6f);
    const RowRange rows = rows_reached(crater, 512);
    EXPECT_GE(rows.begin, 0);
    EXPECT_LE(rows.end, 512);
    EXPECT_LT(rows.begin, rows.end);
  }
}

}  // namespace
}  // namespace halfspace
