// SPDX-License-Identifier: Apache-2.0
#include "halfspace/procedural/patterns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "halfspace/procedural/noise.h"
#include "support/expected_hash.h"
#include "support/hash.h"
#include "support/test_output.h"

namespace halfspace {
namespace {

struct NamedPattern {
  const char* name;
  Pattern pattern;
};
void PrintTo(const NamedPattern& p, std::ostream* os) { *os << p.name; }

class Patterns : public testing::TestWithParam<NamedPattern> {
 protected:
  static PatternMaps make(int width, int threads = 2) { return procedural_pattern(GetParam().pattern, width, Workers(threads)); }
};

INSTANTIATE_TEST_SUITE_P(All, Patterns,
                         testing::Values(NamedPattern{"Checkerboard", Pattern::checkerboard}, NamedPattern{"Grass", Pattern::grass},
                                         NamedPattern{"Bark", Pattern::bark}, NamedPattern{"Bricks", Pattern::bricks},
                                         NamedPattern{"Facade", Pattern::facade}, NamedPattern{"Rock", Pattern::rock},
                                         NamedPattern{"Hills", Pattern::hills}),
                         [](const auto& p) { return p.param.name; });

uint64_t hash_of(const PatternMaps& m) {
  Hash hash;
  for (const auto* map : {&m.color, &m.specular, &m.emissive}) hash.add_codes(*map);
  for (const uint16_t h : m.height.texels()) {
    hash.add(h & 255u);
    hash.add(h >> 8);
  }
  return hash.value();
}

// The maps are bit-identical for every compiler, SIMD width and processor.
TEST_P(Patterns, MatchTheStoredHash) {
  const PatternMaps maps = make(192);
  std::string name = GetParam().name;
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  EXPECT_TRUE(expect_hash("pattern-" + name, hash_of(maps))) << write_failed_picture("pattern-" + name, maps.color, {});
}

TEST_P(Patterns, AreBitIdenticalForAnyThreadCount) { EXPECT_EQ(hash_of(make(130, 1)), hash_of(make(130, 7))); }

TEST_P(Patterns, FillImagesOfAnySize) {
  for (const int width : {1, 2, 37}) {
    const PatternMaps m = make(width);
    for (const auto* map : {&m.color, &m.specular, &m.emissive}) {
      ASSERT_EQ(map->width(), width);
      ASSERT_EQ(map->height(), width);
      for (const glm::u8vec4& t : map->texels()) EXPECT_EQ(t.w, 255);
    }
    ASSERT_EQ(m.height.width(), width);
  }
}

double difference(const PatternMaps& m, int x0, int y0, int x1, int y1) {
  double d = std::abs(static_cast<int>(m.height.at(x0, y0)) - static_cast<int>(m.height.at(x1, y1))) / 257.0;
  for (int c = 0; c < 3; ++c) {
    for (const auto* map : {&m.color, &m.specular, &m.emissive})
      d += std::abs(static_cast<int>(map->at(x0, y0)[c]) - static_cast<int>(map->at(x1, y1)[c]));
  }
  return d;
}

// Opposite edges are adjacent when tiled, so the map must not change more across them than between adjacent texels elsewhere.
TEST_P(Patterns, TileSeamlessly) {
  const int n = 256;
  const PatternMaps m = make(n);
  double across[2] = {}, elsewhere[2] = {};
  for (int i = 0; i < n; ++i) {
    double sums[2] = {};
    for (int k = 0; k < n; ++k) {
      sums[0] += difference(m, i, k, (i + 1) % n, k);
      sums[1] += difference(m, k, i, k, (i + 1) % n);
    }
    for (int axis = 0; axis < 2; ++axis)
      (i == n - 1 ? across : elsewhere)[axis] = std::max((i == n - 1 ? across : elsewhere)[axis], sums[axis]);
  }
  for (int axis = 0; axis < 2; ++axis) EXPECT_LE(across[axis], elsewhere[axis]);
}

// The noise is periodic except for the rounding of u + 1 (2^-24, times up to 64 cells).
TEST(TiledNoise, IsPeriodic) {
  using namespace procedural;
  for (float u = 0.003f; u < 1.0f; u += 0.0371f) {
    for (float v = 0.011f; v < 1.0f; v += 0.0913f) {
      const auto cloud = [](float a, float b) { return lane(tiled_cloud(Real(a), Real(b), 4, 3, 4, 1024, 5), 0); };
      const auto ridges = [](float a, float b) { return lane(tiled_ridges(Real(a), Real(b), 4, 3, 4, 1024, 5), 0); };
      EXPECT_NEAR(cloud(u, v), cloud(u + 1.0f, v), 1e-4);
      EXPECT_NEAR(cloud(u, v), cloud(u, v - 1.0f), 1e-4);
      EXPECT_NEAR(ridges(u, v), ridges(u - 1.0f, v + 1.0f), 1e-4);
    }
  }
}

// Octaves that are too fine for the texels to represent are omitted.
TEST(TiledNoise, OmitsOctavesFinerThanTheTexels) {
  using namespace procedural;
  const auto at = [](int octaves, int texels) { return lane(tiled_cloud(Real(0.31f), Real(0.77f), 8, 8, octaves, texels, 5), 0); };
  EXPECT_EQ(at(9, 64), at(3, 1 << 20));
  EXPECT_NE(at(9, 64), at(4, 1 << 20));
  EXPECT_EQ(at(9, 15), 0.0f);
}

TEST(Checkerboard, IsExact) {
  for (const int width : {8, 64, 200}) {
    const PatternMaps m = procedural_pattern(Pattern::checkerboard, width, Workers(1));
    const int square = width / 8;
    for (int y = 0; y < width; ++y) {
      for (int x = 0; x < width; ++x) {
        const uint8_t code = (x / square + y / square) % 2 == 0 ? 255 : 0;
        ASSERT_EQ(m.color.at(x, y), glm::u8vec4(code, code, code, 255)) << x << " " << y;
      }
    }
  }
}

// Checks mean colors and the fractions of certain colors, to verify that each pattern looks like its name.
glm::dvec3 mean_of(const Image<glm::u8vec4>& map) {
  glm::dvec3 sum(0.0);
  for (const glm::u8vec4& t : map.texels()) sum += glm::dvec3(t.x, t.y, t.z);
  return sum / static_cast<double>(map.texels().size());
}

TEST(PatternsLook, MatchesTheName) {
  const auto mean = [](Pattern p) { return mean_of(procedural_pattern(p, 128, Workers(2)).color); };
  const glm::dvec3 grass = mean(Pattern::grass), bark = mean(Pattern::bark), bricks = mean(Pattern::bricks), rock = mean(Pattern::rock);
  EXPECT_TRUE(grass.y > grass.x && grass.x > grass.z) << "green";
  EXPECT_TRUE(bark.x > bark.y && bark.y > bark.z && bark.x < 140) << "brown";
  EXPECT_GT(bricks.x, 1.3 * bricks.y) << "red";
  EXPECT_LT(std::abs(rock.x - rock.z), 30) << "gray";
  const PatternMaps facade = procedural_pattern(Pattern::facade, 128, Workers(2));
  int lit = 0, shiny = 0, both = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      const bool is_lit = facade.emissive.at(x, y).x > 60;
      lit += is_lit;
      shiny += facade.specular.at(x, y).x > 150;
      both += is_lit && facade.specular.at(x, y).x > 41;  // the value of a frame is 0.16 · 255
    }
  }
  EXPECT_NEAR(shiny / 16384.0, 0.225 * 0.56 * 2, 0.02) << "area of the panes";
  EXPECT_EQ(both, lit) << "only glass emits light";
  EXPECT_GT(lit, shiny / 8);
  EXPECT_LT(lit, shiny * 2 / 3);
}

TEST(PatternsLook, HeightsUseTheFullRange) {
  for (const Pattern p : {Pattern::bark, Pattern::bricks, Pattern::rock, Pattern::hills}) {
    const PatternMaps m = procedural_pattern(p, 256, Workers(2));
    uint16_t low = 65535, high = 0;
    int clipped = 0;
    for (const uint16_t h : m.height.texels()) {
      low = std::min(low, h);
      high = std::max(high, h);
      clipped += h == 0 || h == 65535;
    }
    EXPECT_LT(low, 20000) << static_cast<int>(p);
    EXPECT_GT(high, 40000) << static_cast<int>(p);
    EXPECT_LT(clipped, 256 * 256 / 20) << static_cast<int>(p);
  }
}

}  // namespace
}  // namespace halfspace
