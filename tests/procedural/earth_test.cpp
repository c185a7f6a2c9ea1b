// SPDX-License-Identifier: Apache-2.0
#include "halfspace/procedural/earth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "support/expected_hash.h"

namespace halfspace {
namespace {

int difference(const glm::u8vec4& a, const glm::u8vec4& b) {
  int d = 0;
  for (int c = 0; c < 3; ++c) d = std::max(d, std::abs(static_cast<int>(a[c]) - static_cast<int>(b[c])));
  return d;
}

// Returns the maximum and the mean difference between two columns.
std::pair<int, double> column_difference(const Image<glm::u8vec4>& map, int a, int b) {
  int max_difference = 0;
  double sum = 0;
  for (int y = 0; y < map.height(); ++y) {
    const int d = difference(map.at(a, y), map.at(b, y));
    max_difference = std::max(max_difference, d);
    sum += d;
  }
  return {max_difference, sum / map.height()};
}

TEST(ProceduralEarth, CombinedMapsMatchSeparateMaps) {
  for (const int width : {1, 37, 200}) {
    const EarthMaps maps = procedural_earth_maps(width, 50, Workers(2));
    EXPECT_TRUE(maps.color == procedural_earth(width, 50, Workers(1)));
    EXPECT_TRUE(maps.height == procedural_earth_heights(width, 50, Workers(1)));
  }
}

// The image is bit-identical for every compiler, SIMD width and processor.
TEST(ProceduralEarth, MatchesTheStoredHash) { expect_picture("earth", procedural_earth(512, 256, Workers(1))); }

TEST(ProceduralEarth, IsBitIdenticalForAnyThreadCount) {
  EXPECT_TRUE(procedural_earth(200, 100, Workers(1)) == procedural_earth(200, 100, Workers(7)));
}

// The minimum sizes, and a width that is not a multiple of the SIMD width.
TEST(ProceduralEarth, FillsImagesOfAnySize) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(37, 19), std::pair(2, 50)}) {
    const Image<glm::u8vec4> map = procedural_earth(width, height, Workers(1));
    ASSERT_EQ(map.width(), width);
    ASSERT_EQ(map.height(), height);
    for (const glm::u8vec4& t : map.texels()) {
      EXPECT_EQ(t.w, 255);
      EXPECT_GT(t.x + t.y + t.z, 0);
    }
  }
}

// The left and right edges are adjacent on the sphere, so they must not differ more than adjacent columns do elsewhere.
TEST(ProceduralEarth, HasNoSeam) {
  const Image<glm::u8vec4> map = procedural_earth(1024, 512, Workers(2));
  double elsewhere = 0;
  for (int x = 0; x + 1 < map.width(); ++x) elsewhere = std::max(elsewhere, column_difference(map, x, x + 1).second);
  EXPECT_LE(column_difference(map, map.width() - 1, 0).second, elsewhere);
}

// All longitudes coincide at a pole.
TEST(ProceduralEarth, PolesAreNotPinched) {
  const Image<glm::u8vec4> map = procedural_earth(512, 4096, Workers(2));
  for (const int row : {0, 4095}) {
    for (int x = 0; x < map.width(); ++x) EXPECT_LE(difference(map.at(x, row), map.at(0, row)), 6);
  }
}

// Most of the surface is sea, the polar caps are bright, and there are green areas and deserts.
TEST(ProceduralEarth, HasPlausibleColors) {
  const Image<glm::u8vec4> map = procedural_earth(256, 128, Workers(2));
  int sea = 0, green = 0, sand = 0, all = 0;
  for (int y = 8; y < map.height() - 8; ++y) {
    for (int x = 0; x < map.width(); ++x, ++all) {
      const glm::u8vec4 t = map.at(x, y);
      sea += t.z > t.x + 30 && t.z > t.y ? 1 : 0;
      green += t.y > t.x && t.y > t.z ? 1 : 0;
      sand += t.x > t.y && t.y > t.z + 20 && t.x > 150 ? 1 : 0;
    }
  }
  EXPECT_GT(sea, all / 2);
  EXPECT_LT(sea, all * 4 / 5);
  EXPECT_GT(green, all / 20);
  EXPECT_GT(sand, all / 40);
  for (const int row : {0, map.height() - 1}) EXPECT_GT(map.at(0, row).x, 200);
}

}  // namespace
}  // namespace halfspace
