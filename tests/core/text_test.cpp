// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/text.h"

#include <gtest/gtest.h>

#include <array>

namespace halfspace {
namespace {

TEST(NearestName, EditDistanceCountsEveryKindOfTypo) {
  EXPECT_EQ(edit_distance("earth", "earth"), 0);
  EXPECT_EQ(edit_distance("erth", "earth"), 1) << "missing letter";
  EXPECT_EQ(edit_distance("eearth", "earth"), 1) << "extra letter";
  EXPECT_EQ(edit_distance("earty", "earth"), 1) << "wrong letter";
  EXPECT_EQ(edit_distance("erath", "earth"), 1) << "swapped letters";
  EXPECT_EQ(edit_distance("", "earth"), 5);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(NearestName, FindsTheNearestNameOrNone) {
  constexpr std::array<std::string_view, 3> names = {"earth", "moon", "earth.color"};
  EXPECT_EQ(nearest_name("Earth", names), "earth");
  EXPECT_EQ(nearest_name("mon", names), "moon");
  EXPECT_EQ(nearest_name("earth.colour", names), "earth.color");
  EXPECT_EQ(nearest_name("teapot", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), names), "");
}

TEST(NearestName, SuggestionCompletesAnErrorMessage) {
  constexpr std::array<std::string_view, 2> names = {"earth", "moon"};
  EXPECT_EQ(suggestion("erth", names), "; did you mean 'earth'?");
  EXPECT_EQ(suggestion("teapot", names), "; expected one of earth, moon");
  EXPECT_EQ(suggestion("teapot", {}), "; expected none, because none is defined");
}

TEST(Text, PrintableEscapesControlCharactersAndInvalidUtf8) {
  EXPECT_EQ(printable("a b~"), "a b~");
  EXPECT_EQ(printable("tab\t, line\n, escape\x1b, delete\x7f"), R"(tab\x09, line\x0a, escape\x1b, delete\x7f)");
  EXPECT_EQ(printable("\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80"), "\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80");
  EXPECT_EQ(printable("\xff"), R"(\xff)");
  EXPECT_EQ(printable("\xe2\x82"), R"(\xe2\x82)") << "truncated";
  EXPECT_EQ(printable("\xe2 a"), R"(\xe2 a)");
  EXPECT_EQ(printable("\xc0\xaf"), R"(\xc0\xaf)") << "longer than necessary";
  EXPECT_EQ(printable("\xe0\x9f\xbf"), R"(\xe0\x9f\xbf)") << "longer than necessary";
  EXPECT_EQ(printable("\xed\xa0\x80"), R"(\xed\xa0\x80)") << "a surrogate";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), R"(\xf4\x90\x80\x80)") << "above U+10FFFF";
  EXPECT_EQ(printable(std::string_view("\0", 1)), R"(\x00)");
  EXPECT_EQ(printable("\xc2\x9b\xc2\xa0"), "\\xc2\\x9b\xc2\xa0") << "U+009B starts an escape sequence, U+00A0 is a space";
}

TEST(Text, LinesAndColumnsBeginAtOne) {
  EXPECT_EQ(line_and_column("abc", 1), "1:1");
  EXPECT_EQ(line_and_column("abc", 3), "1:3");
  EXPECT_EQ(line_and_column("a\nbc\n", 4), "2:2");
  EXPECT_EQ(line_and_column("a\nbc\n", 99), "3:1") << "the end of the text";
  EXPECT_EQ(line_and_column("", 0), "1:1");
}

TEST(Text, FindsTheQuotedPartOfAMessage) {
  EXPECT_EQ(position_of_quoted("[1, 1e999]", "number overflow parsing '1e999'"), 5u);
  EXPECT_EQ(position_of_quoted("a b", "first 'a', last 'b'"), 3u);
  EXPECT_EQ(position_of_quoted("[1]", "parsing '2'"), 0u);
  for (const char* message : {"", "'", "no quotes", "one ' only"}) EXPECT_EQ(position_of_quoted("'", message), 0u) << message;
}

}  // namespace
}  // namespace halfspace
