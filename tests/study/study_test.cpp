// SPDX-License-Identifier: Apache-2.0
//
// Compares the components shared by the studies with values known in closed form.
#include "halfspace/study/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "halfspace/study/chart.h"
#include "halfspace/study/polygon_area.h"
#include "halfspace/study/shadow_study.h"
#include "halfspace/study/study_files.h"

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

TEST(Labels, StayInsideTheChartAndDoNotOverlap) {
  const ChartBox room{0, 0, 400, 300};
  std::vector<glm::dvec2> points;
  std::vector<double> widths;
  for (int i = 0; i < 12; ++i) {
    points.emplace_back(15 + 33 * i, 150 + 100 * std::sin(0.9 * i));
    widths.push_back(50);
  }
  points.emplace_back(395, 295);  // in a corner
  widths.push_back(80);
  const std::vector<LabelPlace> places = place_labels(points, widths, room);
  std::vector<ChartBox> boxes;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const LabelPlace& p = places[i];
    const double x0 = p.anchor > 0 ? p.x : p.anchor < 0 ? p.x - widths[i] : p.x - 0.5 * widths[i];
    boxes.push_back({x0, p.y - 7, x0 + widths[i], p.y + 7});
    EXPECT_GE(x0, room.x0);
    EXPECT_LE(x0 + widths[i], room.x1);
    EXPECT_LE(p.y + 7, room.y1);
    for (std::size_t k = 0; k < i; ++k) {
      const ChartBox &a = boxes[i], &b = boxes[k];
      EXPECT_FALSE(a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1) << i << " covers " << k;
    }
  }
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
  // A disk of 4,096 wedges, half of which is outside the image.
  std::vector<TrianglePx> disk;
  const auto at = [](int i) {
    return 8.0 * glm::dvec2(std::cos(i * std::numbers::pi / 2048), std::sin(i * std::numbers::pi / 2048)) + glm::dvec2(0, 10);
  };
  for (int i = 0; i < 4096; ++i) disk.push_back({glm::dvec2(0, 10), at(i), at(i + 1)});
  // The area of the polygon is smaller than the area of the disk by 4e-7 of it.
  EXPECT_NEAR(total(area_coverage<double>(disk, 20, 20)), 0.5 * std::numbers::pi * 64.0, 1e-3);
}

TEST(ChartScript, ContainsEveryPointLabelAndTheFront) {
  Study study{.name = "s", .title = "It's one", .setting = "x", .error_name = "e", .time_name = "t", .truth = {"m", 1e-9, "n"}};
  study.variants = {variant(0.1, 2.0), variant(0.0, 3.0), variant(0.2, 9.0)};
  for (std::size_t i = 0; i < 3; ++i) study.variants[i].name = "name " + std::to_string(i);
  const std::string script = chart_script(study, pareto_front(study.variants, study.truth.error));
  for (const char* part : {"'name 0'", "'name 1'", "'name 2'", "'It''s one'", "'s.svg'", "'s-dark.svg'", "'s.png'", "set logscale xy",
                           "$front << EOD\n1e-09 3\n0.1 2\nEOD", "error 1.0e-09"})
    EXPECT_NE(script.find(part), std::string::npos) << part << '\n' << script;
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
  // The chart is 1000 px wide and does not wrap its two lines of text, whose characters are about 7.5 px wide.
  constexpr std::size_t kCharacters = 118, kErrorCharacters = 29;  // of a line; of "reference: ", "; error 1.0e-09 (" and ")"
  EXPECT_LE(study.setting.size(), kCharacters);
  EXPECT_LE(study.truth.method.size() + study.truth.error_method.size() + kErrorCharacters, kCharacters);
  std::set<std::string> names;
  double least = 1e300, most = 0.0;
  for (const Variant& v : study.variants) {
    EXPECT_TRUE(names.insert(v.name).second) << v.name << " occurs twice";
    EXPECT_EQ(v.parameters.size(), study.variants[0].parameters.size()) << v.name;
    EXPECT_EQ(v.measures.size(), study.variants[0].measures.size()) << v.name;
    EXPECT_GT(v.time.median_ms, 0.0) << v.name;
    EXPECT_TRUE(std::isfinite(v.error)) << v.name;
    most = std::max(most, v.error);
    if (v.error > study.truth.error) least = std::min(least, v.error);
  }
  // In quick mode the references of the displaced surfaces are only half as fine.
  const double times = study.name == "displacement" || study.name == "normals" ? 3.0 : 9.99;
  EXPECT_GE(least, times * study.truth.error);
  EXPECT_GE(most, 2.0 * least) << "the variants must differ noticeably";
}

INSTANTIATE_TEST_SUITE_P(All, Studies, testing::ValuesIn(studies()), [](const auto& s) { return std::string(s.param.name); });

}  // namespace
}  // namespace halfspace
