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
}

}  // namespace
}  // namespace halfspace
