// SPDX-License-Identifier: Apache-2.0
//
// Compares the components that the studies share with values known in closed form.
#include "study/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "study/polygon_area.h"
#include "study/shadow_study.h"
#include "study/study_files.h"

namespace halfspace {
namespace {

Variant variant(double error, double ms) { return {.name = "v", .group = "g", .error = error, .time = {ms, ms, ms, 1}}; }

TEST(ParetoFront, KeepsNonDominatedVariants) {
  const std::vector<Variant> variants{variant(1, 1), variant(2, 2), variant(0.5, 3), variant(0.5, 4), variant(3, 0.5), variant(1, 1)};
  EXPECT_EQ(pareto_front(variants, 0.0), (std::vector<bool>{true, false, true, false, true, true}))
      << "equal variants do not dominate each other";
  // Errors below the error of the reference count as equal, so time decides.
  EXPECT_EQ(pareto_front(variants, 1.0), (std::vector<bool>{true, false, false, false, true, true}));
}

TEST(Timing, QuartilesEncloseTheMedian) {
  int calls = 0;
  const Timing t = time_of([&] { ++calls; }, {.quick = true});
  EXPECT_EQ(t.runs, 3);
  EXPECT_EQ(calls, 4) << "one call is the warm-up";
  EXPECT_LE(t.low_ms, t.median_ms);
  EXPECT_LE(t.median_ms, t.high_ms);
  EXPECT_GE(time_of([] {}, {}).runs, 9);
}

TEST(FileWord, IsLowercaseLettersDigitsAndDashes) {
  EXPECT_EQ(file_word("Gouraud 16"), "gouraud-16");
  EXPECT_EQ(file_word("curve, encoder's table (used here)"), "curve-encoder-s-table-used-here");
  EXPECT_EQ(file_word("2x2 larger"), "2x2-larger");
}

TEST(AreaCoverage, MatchesClosedFormForTriangles) {
  // The triangle below the diagonal of a 4x4 square covers half of each pixel on the diagonal.
  const std::vector<TrianglePx> half{{glm::dvec2(0, 0), glm::dvec2(4, 0), glm::dvec2(4, 4)}};
  const Image<double> share = area_coverage<double>(half, 5, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      const double want = x == 4 || y == 4 ? 0.0 : x > y ? 1.0 : x == y ? 0.5 : 0.0;
      EXPECT_DOUBLE_EQ(share.at(x, 4 - y), want) << x << ' ' << y;  // row 0 is the top row
    }
  }
  // The sum equals the area of the triangle at any position; parts outside the image do not count.
  const std::vector<TrianglePx> thin{{glm::dvec2(1.1, 7.3), glm::dvec2(30.7, 8.9), glm::dvec2(2.2, 7.9)}};
  const auto total = [](const Image<double>& shares) {
    double sum = 0.0;
    for (const double s : shares.texels()) sum += s;
    return sum;
  };
  const glm::dvec2 a = thin[0][1] - thin[0][0], b = thin[0][2] - thin[0][0];
  EXPECT_NEAR(total(area_coverage<double>(thin, 64, 64)), 0.5 * std::abs(a.x * b.y - a.y * b.x), 1e-12);
  // A disk of 4,096 wedges; half of the disk is outside the image.
  std::vector<TrianglePx> disk;
  const auto at = [](int i) {
    return 8.0 * glm::dvec2(std::cos(i * std::numbers::pi / 2048), std::sin(i * std::numbers::pi / 2048)) + glm::dvec2(0, 10);
  };
  for (int i = 0; i < 4096; ++i) disk.push_back({glm::dvec2(0, 10), at(i), at(i + 1)});
  // The areas of the polygon and the disk differ by a relative 4e-7.
  EXPECT_NEAR(total(area_coverage<double>(disk, 20, 20)), 0.5 * std::numbers::pi * 64.0, 1e-3);
}

// Returns a row as printed by `halfspace validate --table`.
TableRow table_row(const char* factor, const char* scene, const char* method, const char* bias, int resolution, double error) {
  TableRow row{factor, 45.0, {}};
  row.score.scene = scene;
  row.score.method = method;
  row.score.bias = bias;
  row.score.resolution = resolution;
  row.score.error = error;
  row.score.map_ms = 2.0;
  row.score.lookup_ms = 1.0;
  return row;
}

TEST(ShadowTable, GivesAChartOfMeansOverScenes) {
  const Study study =
      shadow_table_study({table_row("bias", "a", "pcf3", "slope", 2048, 0.1), table_row("bias", "a", "pcf3", "auto", 2048, 0.7),
                          table_row("filter", "a", "hard", "auto", 2048, 0.3), table_row("filter", "a", "pcf3", "auto", 2048, 0.7),
                          table_row("resolution", "a", "pcf3", "auto", 512, 0.5), table_row("angle", "a", "pcf3", "auto", 2048, 0.6),
                          table_row("bias", "b", "pcf3", "slope", 2048, 0.3)},
                         480, 270);
  std::vector<std::string> names;
  for (const Variant& v : study.variants) names.push_back(v.name);
  EXPECT_EQ(names, (std::vector<std::string>{"slope", "hard", "512"}))
      << "variants listed among the resolutions occur once, and angles are omitted";
  EXPECT_DOUBLE_EQ(study.variants[0].error, 0.2);
  EXPECT_DOUBLE_EQ(study.variants[0].time.median_ms, 3.0) << "sum of map and lookup";
  EXPECT_GT(study.truth.error, 0.0);
  // For a full table, the chart has every filter with every bias, at a resolution of 2048.
  const Study full =
      shadow_table_study({table_row("all", "a", "hard", "slope", 2048, 0.1), table_row("all", "a", "hard", "slope", 512, 0.9)}, 480, 270);
  ASSERT_EQ(full.variants.size(), 1u);
  EXPECT_EQ(full.variants[0].name, "hard slope");
  EXPECT_DOUBLE_EQ(full.variants[0].error, 0.1);
}

// Runs every study at reduced size. Its data must be complete, and its reference must be more accurate than its best variant.
class Studies : public testing::TestWithParam<StudyEntry> {};

TEST_P(Studies, ProduceCompleteData) {
  const Workers workers(2);
  const Study study = GetParam().run({.quick = true}, workers);
  EXPECT_EQ(study.name, GetParam().name);
  ASSERT_GE(study.variants.size(), 3u);
  EXPECT_GT(study.truth.error, 0.0) << "every reference has an error";
  // The chart does not wrap its two lines of text. draw_charts_test.py tests that lines of this length fit.
  constexpr std::size_t kCharacters = 118, kErrorCharacters = 29;  // per line; in "reference: ; error 1.0e-09 ()"
  EXPECT_LE(study.setting.size(), kCharacters);
  EXPECT_LE(study.truth.method.size() + study.truth.error_method.size() + kErrorCharacters, kCharacters);
  std::set<std::string> names;
  double min_error = 1e300, max_error = 0.0;
  for (const Variant& v : study.variants) {
    EXPECT_TRUE(names.insert(v.name).second) << v.name << " occurs twice";
    EXPECT_EQ(v.parameters.size(), study.variants[0].parameters.size()) << v.name;
    EXPECT_EQ(v.measures.size(), study.variants[0].measures.size()) << v.name;
    EXPECT_GT(v.time.median_ms, 0.0) << v.name;
    EXPECT_TRUE(std::isfinite(v.error)) << v.name;
    max_error = std::max(max_error, v.error);
    if (v.error > study.truth.error) min_error = std::min(min_error, v.error);
  }
  // In quick mode the references of the displaced surfaces are only half as fine.
  const double times = study.name == "displacement" || study.name == "normals" || study.name == "terminator" ? 3.0 : 9.99;
  EXPECT_GE(min_error, times * study.truth.error);
  EXPECT_GE(max_error, 2.0 * min_error) << "the variants must differ noticeably";
}

INSTANTIATE_TEST_SUITE_P(All, Studies, testing::ValuesIn(studies()), [](const auto& s) { return std::string(s.param.name); });

}  // namespace
}  // namespace halfspace
