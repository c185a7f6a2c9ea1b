// SPDX-License-Identifier: Apache-2.0
//
// Checks the text of the page: its chapters, its quotes of source code, and that its numbers do not depend on the number of threads.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "explain/page.h"
#include "explain/page_encode.h"
#include "explain/page_history.h"
#include "explain/page_quotes.h"
#include "explain/prepared.h"
#include "halfspace/image/png.h"
#include "halfspace/render/frame/frame.h"
#include "support/files.h"
#include "support/long_tests.h"

namespace halfspace {
namespace {

std::string page_of(const std::string& scene, int threads) {
  const PreparedText s(SceneFile::open(scene).at(0.0), 96, 54, threads);
  return explain_page(s.description, s.prepared, {scene, "halfspace explain " + scene, "halfspace render " + scene, "test", {}, {}},
                      s.workers);
}

// Returns the data of a page.
nlohmann::json data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(Page, HasAllChapters) {
  const std::string page = page_of("earth", 2);
  for (const char* id : {"frame",    "spaces",        "geometry", "clipping", "culling",  "setup",      "binning", "coverage", "depth",
                         "stepping", "interpolation", "varyings", "mips",     "lighting", "shadows",    "tone",    "srgb",     "samples",
                         "layers",   "final",         "history",  "overdraw", "times",    "statistics", "results"})
    EXPECT_NE(page.find("id: \"" + std::string(id) + "\""), std::string::npos) << id;
  EXPECT_EQ(page.find("http://") != std::string::npos, page.find("http://www.w3.org/2000/svg") != std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos) << "the page must not need a network";
}

TEST(Page, NumbersDoNotDependOnThreads) {
  const auto without_times = [](nlohmann::json json) {
    json.erase("tile_times");
    return json;
  };
  for (const char* scene : {"day-night", "particles"})
    EXPECT_EQ(without_times(data_of(page_of(scene, 1))), without_times(data_of(page_of(scene, 2)))) << scene;
}

// Returns the data of the page of a scene with some settings.
nlohmann::json page_data(const std::string& scene, const std::vector<std::string>& settings, int width, int height) {
  SceneFile file = SceneFile::open(scene);
  file.set(settings);
  const PreparedText s(file.at(0.0), width, height);
  return data_of(explain_page(s.description, s.prepared, {scene, "halfspace explain " + scene, "halfspace render " + scene, "test", {}, {}},
                              s.workers));
}

// The formulas of the page start with the light that the frame stores, so they end in the pixel of the picture.
TEST(Page, TheToneChapterEndsInThePicture) {
  for (const ShippedScene& shipped : shipped_scenes()) {
    for (const int samples : {1, 4, 8}) {
      if (samples > 1 && !runs_long_tests() && shipped.name != shipped_scenes().front().name) continue;
      const std::string name(shipped.name);
      const std::vector<std::string> settings{"samples=" + std::to_string(samples)};
      const nlohmann::json data = page_data(name, settings, 48, 27), &tone = data["tone"];
      SceneFile file = SceneFile::open(name);
      file.set(settings);
      const PreparedText s(file.at(0.0), 48, 27);
      Image<glm::u8vec4> picture(48, 27);
      render(s.prepared, picture, s.workers);
      const glm::u8vec4 expected = picture.at(data["pixel"][0].get<int>(), data["pixel"][1].get<int>());
      EXPECT_EQ(tone["samples"].size(), static_cast<std::size_t>(samples));
      for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        EXPECT_EQ(tone["pixel"]["code"][i].get<int>(), int{expected[k]}) << name << samples;
        if (!tone["dither"].get<bool>()) {
          EXPECT_EQ(tone["pixel"]["rounded"][i].get<int>(), int{expected[k]}) << name << samples;
        }
      }
    }
  }
}

// Twenty-four panes, one behind the other and drawn from back to front.
std::string many_layers() {
  std::string objects;
  for (int i = 0; i < 24; ++i)
    objects += fmt::format(R"({}"pane{}": {{"shape": "plane", "size": 2, "rotation": [90, 0, 0], "position": [0, 0, {}]}})",
                           i == 0 ? "" : ", ", i, -12.0 + 0.25 * i);
  return R"({"version": 1, "samples": 2, "cameras": {"c": {"position": [0, 0, 6], "target": [0, 0, 0]}}, "lights": {"sun": {}}, "objects": {)" +
         objects + "}}";
}

// All fragments of the example pixel are listed, with their values.
TEST(Page, TheExamplePixelIsComplete) {
  const PreparedText s(many_layers(), 64, 36);
  const FrameTrace trace = trace_frame(s.prepared, s.workers);
  const glm::ivec2 pixel = trace.busiest_pixel();
  ASSERT_GT(trace.at(pixel).size(), 40u);
  const nlohmann::json history = data_of(explain_page(s.description, s.prepared, {"test", "", "", "test", {}, {}}, s.workers))["history"];
  EXPECT_EQ(history["most"], 64);
  EXPECT_EQ(history["details"]["most"][0], 64);
}

TEST(Page, TheDetailedPixelsContainTheExamplePixel) {
  for (const glm::ivec2 center : {glm::ivec2(0, 0), glm::ivec2(639, 359), glm::ivec2(321, 183)}) {
    const std::vector<glm::ivec2> pixels = detailed_pixels(640, 360, center);
    EXPECT_EQ(std::ranges::count(pixels, center), 1);
    EXPECT_GE(pixels.size(), 64u * 64u + 80u * 45u - 64u) << "64 pixels of the grid are in the block";
  }
}

TEST(Page, ShowsWhatAGeometryFunctionEmits) {
  const auto data_with = [](const std::string& keys) {
    const PreparedText s(R"({"version": 1, "cameras": {"c": {"position": [0, 4, 3], "target": [0, 0, 0]}}, "lights": {"sun": {}},
      "objects": {"a": {"shape": "plane", "size": 2, "segments": 2)" +
                             keys + "}}}",
                         64, 36);
    return data_of(explain_page(s.description, s.prepared, {"test", "", "", "test", {}, {}}, s.workers));
  };
  EXPECT_TRUE(data_with("")["emission"].is_null());
  const nlohmann::json data = data_with(R"(, "normal_lines": 0.1)"), &e = data["emission"];
  ASSERT_EQ(e["draws"].size(), 1u);
  EXPECT_EQ(e["calls"], 8);
  EXPECT_EQ(e["draws"][0]["received"], 8);
  EXPECT_EQ(e["draws"][0]["emitted"], 24);
  EXPECT_EQ(e["example"]["emitted"].size(), 3u);
  EXPECT_EQ(data["draws"][0]["kind"], "triangles");
  EXPECT_EQ(data["draws"][1]["kind"], "lines");
  EXPECT_EQ(data["draws"][1]["primitives"], 24);
}

// A ball of 9000 spheres, each of which covers a pixel of the only tile.
TEST(Page, StepsOfATileAreLimited) {
  const PreparedText s(R"({"version": 1, "cameras": {"c": {"position": [0, 0, 9], "target": [0, 0, 0]}}, "lights": {"sun": {}},
    "particles": {"sprite": "exact", "arrangement": "ball", "count": 9000}})",
                       64, 64);
  const nlohmann::json tile = data_of(explain_page(s.description, s.prepared, {"test", "", "", "test", {}, {}}, s.workers))["tile"];
  const auto number = [&](const char* key) { return tile[key].get<std::size_t>(); };
  EXPECT_EQ(tile["triangles"].size(), 4096u);
  EXPECT_GT(number("triangles_left_out"), 1000u);
  EXPECT_GE(number("left_out"), number("triangles_left_out"));
  const FrameTrace trace = trace_frame(s.prepared, s.workers);
  std::size_t fragments = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) fragments += trace.at({x, y}).size();
  }
  EXPECT_EQ(tile["fragments"]["count"].get<std::size_t>() + number("left_out"), fragments);
}

TEST(Page, SmallPicturesAreDetailedCompletely) {
  EXPECT_EQ(detailed_pixels(320, 180, {0, 0}).size(), 320u * 180u);
  EXPECT_LT(detailed_pixels(321, 180, {0, 0}).size(), 321u * 180u / 4);
}

// Between vertices with w = 1 and w = 4, interpolation differs by at most (√4 − √1) / (√4 + √1) = 1/3 of an edge.
TEST(Page, AConstructedTriangleShowsTheInterpolation) {
  const nlohmann::json p = page_data("earth", {}, 96, 54)["perspective"];
  EXPECT_EQ(p["kind"], "constructed");
  EXPECT_DOUBLE_EQ(p["difference"].get<double>(), 1.0 / 3.0);
  EXPECT_LT(p["largest_error"].get<double>(), 0.5);
  EXPECT_NE(page_data("pipeline", {}, 96, 54)["perspective"]["kind"], "constructed");
}

TEST(Page, QuotesAreTheLinesOfTheSources) {
  for (const QuoteRange& range : quote_ranges()) {
    const Quote q = quote(range);
    ASSERT_NE(q.line, 0) << range.file << ": no lines from '" << range.from << "' to '" << range.to << "'";
    const std::string file = read_bytes(q.file);
    std::size_t at = 0;
    for (int line = 1; line < q.line; ++line) at = file.find('\n', at) + 1;
    const std::string first = q.text.substr(0, q.text.find('\n'));
    EXPECT_EQ(file.substr(file.find_first_not_of(' ', at), first.size()), first) << q.file << ":" << q.line;
    EXPECT_LE(std::ranges::count(q.text, '\n'), 30) << range.file << ": a quote should fit on a screen";
  }
}

// Returns the texts in quotation marks of each list of the page that follows `key`.
std::vector<std::string> names_in(const std::string& page, const std::string& key) {
  std::vector<std::string> names;
  for (std::size_t at = page.find(key); at != std::string::npos; at = page.find(key, at + 1)) {
    const std::string list = page.substr(at + key.size(), page.find(']', at) - at - key.size());
    for (std::size_t open = list.find('"'); open != std::string::npos; open = list.find('"', list.find('"', open + 1) + 1))
      names.push_back(list.substr(open + 1, list.find('"', open + 1) - open - 1));
  }
  return names;
}

// The page names lessons by their titles, and the number of a title in its list is that of the lesson's file.
TEST(Page, NamedLessonsExist) {
  const std::string page = page_of("earth", 2);
  const std::vector<std::string> titles = names_in(page, "const LESSONS = ["), named = names_in(page, "lessons: [");
  ASSERT_EQ(titles.size(), 24u);
  for (std::size_t i = 0; i < titles.size(); ++i) {
    const std::string text = read_bytes(fmt::format("docs/tutorial/lessons/{:02}.md", i + 1));
    EXPECT_EQ(text.substr(0, text.find('\n')), fmt::format("# Lesson {}: {}", i + 1, titles[i]));
  }
  EXPECT_GT(named.size(), 15u);
  for (const std::string& title : named) EXPECT_EQ(std::ranges::count(titles, title), 1) << title;
}

TEST(Page, PackedBytesAreAPngFile) {
  const std::array<std::byte, 5> bytes{std::byte{1}, std::byte{2}, std::byte{255}, std::byte{0}, std::byte{7}};
  const std::string base64 = packed_bytes(bytes);
  EXPECT_EQ(base64.substr(0, 11), "iVBORw0KGgo") << "the PNG signature";
  EXPECT_EQ(base64.size() % 4, 0u);
  EXPECT_EQ(packed_bytes({}), "");
}

TEST(Page, PlanesHaveTheFirstBytesFirst) {
  const std::array<uint16_t, 2> values{0x0201, 0x0403};
  const std::array<std::byte, 4> planes{std::byte{1}, std::byte{3}, std::byte{2}, std::byte{4}};
  EXPECT_EQ(packed_planes(std::span<const uint16_t>(values)), packed_bytes(planes));
}

TEST(Page, DataCannotCloseTheScriptElement) {
  EXPECT_EQ(script_safe("a</script>b</c"), "a<\\/script>b<\\/c");
  EXPECT_EQ(script_safe("a < b / c"), "a < b / c");
}

TEST(Page, HeatColorsGetLighter) {
  int last = -1;
  for (int i = 0; i <= 24; ++i) {
    const glm::u8vec4 c = heat_color(static_cast<float>(i) / 24.0f);
    const int lightness = 2 * c.x + 5 * c.y + c.z;
    EXPECT_GT(lightness, last);
    last = lightness;
  }
}

}  // namespace
}  // namespace halfspace
