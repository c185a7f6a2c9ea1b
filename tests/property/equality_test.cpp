// SPDX-License-Identifier: Apache-2.0
//
// Draws random scenes with the tile path and the oracle, and again with the tile path at different thread counts, tile sizes, chunk sizes
// and budgets, deferred and immediate. The results must be identical byte for byte.
//
// HALFSPACE_SEED=n   runs only scene n of each theme and prints it (select the theme with --gtest_filter)
// HALFSPACE_DRAW=k   in addition, runs only draw k of the scene
// HALFSPACE_STATES=n runs n scenes of each theme
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "property/random_scene.h"
#include "support/long_tests.h"

namespace halfspace {

namespace {

constexpr uint64_t kScenes = 50, kScenesOfLongTests = 350;

struct Variant {
  PassOptions options;
  int threads = 1;
};

PassOptions random_options(Random& random) {
  PassOptions o;
  o.tuning.tile_size = random.pick({8, 16, 32, 64});
  o.tuning.chunk_triangles = random.pick({1u, 7u, 8192u});
  o.tuning.defer = random.once_in(2);
  if (random.once_in(2)) o.tuning.bin_budget = random.pick({1u, 1000u, 20000u});
  return o;
}

// Returns alternative options that must give the same result. Every scene is drawn with immediate shading, with a flush during the pass,
// and with more threads than cores. Every combination occurs in some scene.
std::vector<Variant> variants(uint64_t seed) {
  Random random(seed ^ 0x5eed);
  std::vector<Variant> v;
  v.push_back({.options = {.tuning = {.defer = false}}});
  v.push_back({.options = {.tuning = {.chunk_triangles = 1, .bin_budget = 1}}, .threads = 2});
  v.push_back({.options = random_options(random), .threads = 7});
  v.push_back({.options = random_options(random)});
  if (seed % 8 == 0) v.push_back({.options = random_options(random), .threads = 64});
  return v;
}

std::string statistics_difference(const PassStatistics& s, const oracle::Counts& c) {
  std::string out;
  const auto check = [&out](const char* name, uint64_t pass, uint64_t oracle) {
    if (pass != oracle) out += std::string(name) + ": " + std::to_string(oracle) + " expected, got " + std::to_string(pass) + "\n";
  };
  check("vertices_shaded", s.vertices_shaded, c.vertices_shaded);
  check("patches_in", s.patches_in, c.patches_in);
  check("vertices_evaluated", s.vertices_evaluated, c.vertices_evaluated);
  check("geometry_invocations", s.geometry_invocations, c.geometry_invocations);
  check("primitives_in", s.primitives_in, c.primitives_in);
  check("culled_non_finite", s.culled_non_finite, c.culled_non_finite);
  check("culled_outside", s.culled_outside, c.culled_outside);
  check("culled_face", s.culled_face, c.culled_face);
  if (!c.has_lines) {
    check("culled_degenerate", s.culled_degenerate, c.culled_degenerate);
    check("culled_no_sample", s.culled_no_sample, c.culled_no_sample);
    check("triangles_binned", s.triangles_binned, c.triangles);
  }
  check("clipped", s.clipped, c.clipped);
  check("samples_passed", s.samples_passed, c.samples_passed);
  for (const auto& [query, samples] : c.queries) check("a query", s.queries.at(query), samples);
  return out;
}

// Returns a description of the first error in a scene; empty if there is none.
std::string check_scene(const Scene& scene, uint64_t seed) {
  const OracleResult oracle = run_oracle(scene);
  const PassResult base = run_pass(scene, {}, 1);
  std::string wrong = difference(scene, oracle.pictures, base.pictures);
  if (!wrong.empty()) return "tile path differs from the oracle: " + wrong;
  wrong = statistics_difference(base.statistics, oracle.counts);
  if (!wrong.empty()) return "statistics differ from the oracle: " + wrong;
  for (const Variant& v : variants(seed)) {
    const PassResult other = run_pass(scene, v.options, v.threads);
    wrong = difference(scene, base.pictures, other.pictures);
    if (!wrong.empty()) return describe(v.options, v.threads) + ": " + wrong;
    if (v.threads == 1 || seed % 4 != 0) continue;
    if (run_pass(scene, v.options, 1).statistics != other.statistics)
      return describe(v.options, v.threads) + ": statistics differ from the run with one thread";
  }
  return {};
}

class RandomScenes : public testing::TestWithParam<Theme> {};

TEST_P(RandomScenes, MatchTheOracleForAnyThreadsTilesChunksAndFlushes) {
  const Theme theme = GetParam();
  const char* one = std::getenv("HALFSPACE_SEED");
  const char* many = std::getenv("HALFSPACE_STATES");
  const uint64_t first = one != nullptr ? std::strtoull(one, nullptr, 10) : 0;
  const uint64_t count = one != nullptr      ? 1
                         : many != nullptr   ? std::strtoull(many, nullptr, 10)
                         : runs_long_tests() ? kScenesOfLongTests
                                             : kScenes;
  uint64_t draws = 0, pixels = 0, passed = 0, triangles = 0;
  for (uint64_t seed = first; seed < first + count; ++seed) {
    Scene scene = random_scene(theme, seed);
    if (const char* draw = std::getenv("HALFSPACE_DRAW"); draw != nullptr && one != nullptr) {
      scene.draws = {scene.draws.at(std::strtoull(draw, nullptr, 10))};
    }
    if (one != nullptr) std::printf("%s", describe(scene).c_str());
    const std::string wrong = check_scene(scene, seed);
    ASSERT_EQ(wrong, "") << "seed " << seed << ": HALFSPACE_SEED=" << seed << " test-property --gtest_filter='*RandomScenes*/"
                         << kThemeNames[static_cast<int>(theme)] << "'\n"
                         << describe(scene);
    draws += scene.draws.size();
    pixels += static_cast<uint64_t>(scene.width) * static_cast<uint64_t>(scene.height);
    const PassStatistics s = run_pass(scene, {}, 1).statistics;
    passed += s.samples_passed;
    triangles += s.triangles_binned;
  }
  std::printf("%llu scenes, %llu draw states, %llu pixels, %llu triangles, %llu samples passed\n", static_cast<unsigned long long>(count),
              static_cast<unsigned long long>(draws), static_cast<unsigned long long>(pixels), static_cast<unsigned long long>(triangles),
              static_cast<unsigned long long>(passed));
}

INSTANTIATE_TEST_SUITE_P(Themes, RandomScenes, testing::ValuesIn(kThemes),
                         [](const auto& theme) { return std::string(kThemeNames[static_cast<int>(theme.param)]); });

}  // namespace

}  // namespace halfspace
