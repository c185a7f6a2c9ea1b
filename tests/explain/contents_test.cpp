// SPDX-License-Identifier: Apache-2.0
//
// Checks the text of the page: its chapters, its quotes of source code, and that its numbers do not depend on the number of threads.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "explain/prepared.h"
#include "halfspace/explain/page.h"
#include "halfspace/explain/page_encode.h"
#include "halfspace/explain/page_quotes.h"
#include "halfspace/image/png.h"
#include "support/files.h"

namespace halfspace {
namespace {

std::string page_of(const std::string& scene, int threads) {
  const PreparedText s(SceneFile::open(scene).at(0.0), 96, 54, threads);
  return explain_page(s.description, s.prepared, {scene, "halfspace explain " + scene, "test", {}}, s.workers);
}

// Returns the data of a page.
nlohmann::json data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(Page, HasAllChapters) {
  const std::string page = page_of("earth", 2);
  for (const char* id : {"frame",         "spaces",   "clipping", "culling",  "setup",   "binning",   "coverage", "depth",
                         "interpolation", "varyings", "mips",     "lighting", "shadows", "tone",      "srgb",     "samples",
                         "layers",        "final",    "history",  "overdraw", "times",   "statistics"})
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

TEST(Page, QuotesAreTheLinesOfTheSources) {
  for (const QuoteRange& range : quote_ranges()) {
    const Quote q = quote(range);
    ASSERT_NE(q.line, 0) << range.file << ": no lines from '" << range.from << "' to '" << range.to << "'";
    const std::string file = read_bytes("src/" + q.file);
    std::size_t at = 0;
    for (int line = 1; line < q.line; ++line) at = file.find('\n', at) + 1;
    const std::string first = q.text.substr(0, q.text.find('\n'));
    EXPECT_EQ(file.substr(file.find_first_not_of(' ', at), first.size()), first) << q.file << ":" << q.line;
    EXPECT_LE(std::ranges::count(q.text, '\n'), 30) << range.file << ": a quote should fit on a screen";
  }
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
