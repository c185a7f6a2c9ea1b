// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/up_axis_hint.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "model/obj_reading.h"
#include "support/files.h"

namespace halfspace {
namespace {

// Whether z-up is suggested for a box with these bounds.
bool is_suggested(const glm::dvec3& low, const glm::dvec3& high) {
  std::string text;
  for (int i = 0; i < 8; ++i) text += fmt::format("v {} {} {}\n", (i & 1 ? high : low).x, (i & 2 ? high : low).y, (i & 4 ? high : low).z);
  return !up_axis_hint(read_obj_text(text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\n")).empty();
}

TEST(UpAxisHint, SuggestsZForBuildingsAndMaps) {
  EXPECT_TRUE(is_suggested({-6, -4, 0}, {6, 4, 9})) << "a house";
  EXPECT_TRUE(is_suggested({-6, -4, -0.5}, {6, 5, 9})) << "with a foundation";
  EXPECT_TRUE(is_suggested({-200, -200, 0}, {200, 200, 30})) << "a town";
  EXPECT_TRUE(is_suggested({500100, 5400200, 112}, {500160, 5400240, 131})) << "map coordinates";
}

TEST(UpAxisHint, IsSilentForModelsThatStandOnY) {
  EXPECT_FALSE(is_suggested({-6, 0, -4}, {6, 9, 4})) << "a house";
  EXPECT_FALSE(is_suggested({-1, -1, -1}, {1, 1, 1}));
  EXPECT_FALSE(is_suggested({0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(is_suggested({0, 0, 0}, {9, 21, 0.4})) << "a door";
  EXPECT_FALSE(is_suggested({-9, -5, 0}, {9, 5, 0.1})) << "a panel";
  EXPECT_FALSE(is_suggested({-1, -1, 0}, {1, 1, 0}));
  EXPECT_FALSE(is_suggested({-200, -1, -200}, {200, 3, 200})) << "a street";
  EXPECT_FALSE(is_suggested({500100, 112, -5400240}, {500160, 131, -5400200})) << "map coordinates";
  EXPECT_FALSE(is_suggested({50, 60, 0}, {51, 61, 1})) << "an object in a row of others";
}

TEST(UpAxisHint, IsOnlyForFormatsWithoutAnUpAxis) {
  Model model = read_obj_text("v -6 -4 0\nv 6 -4 0\nv 0 4 9\nf 1 2 3\n");
  EXPECT_NE(up_axis_hint(model).find("--up-axis z"), std::string::npos);
  model.up = UpAxis::z;
  EXPECT_EQ(up_axis_hint(model), "");
  model.up = UpAxis::y;
  model.format = "glTF";
  EXPECT_EQ(up_axis_hint(model), "");
}

// Of these models, only one stands on z = 0.
TEST(UpAxisHint, HasFewFalseAlarms) {
  const std::filesystem::path folder = shared_data("");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << absent(folder);
  std::set<std::string> suggested;
  for (const char* name : {"meshes", "models"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / name)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".obj" && extension != ".ply") continue;
      if (!up_axis_hint(read_model(entry.path())).empty()) suggested.insert(entry.path().filename().string());
    }
  }
  EXPECT_EQ(suggested, std::set<std::string>{"teapot_mitsuba.ply"});
}

}  // namespace
}  // namespace halfspace
