// SPDX-License-Identifier: Apache-2.0
//
// Compares the errors inside of outlines with values computed by hand.
#include "halfspace/reference/inside_error.h"

#include <gtest/gtest.h>

namespace halfspace {
namespace {

TEST(InsideError, CountsColorsAndOutlinesApart) {
  // A row of 200 inside pixels, of which three differ, a pixel that only the truth shows, and a pixel of the background.
  constexpr int kInside = 200;
  Image<glm::u8vec4> colors(kInside + 2, 1), true_colors(kInside + 2, 1);
  Image<int> objects(kInside + 2, 1), true_objects(kInside + 2, 1);
  for (int x = 0; x < kInside; ++x) objects.at(x, 0) = true_objects.at(x, 0) = 1;
  true_objects.at(kInside, 0) = 1;
  colors.at(0, 0) = {0, 7, 0, 255};
  colors.at(1, 0) = {3, 0, 2, 0};  // alpha does not count
  true_colors.at(2, 0) = {0, 0, 100, 0};
  colors.at(kInside, 0) = colors.at(kInside + 1, 0) = glm::u8vec4(255);  // neither is inside
  const InsideError error = inside_error({colors, objects}, {true_colors, true_objects});
  EXPECT_EQ(error.inside, kInside);
  EXPECT_EQ(error.differing, 1);
  EXPECT_DOUBLE_EQ(error.mean, (7.0 + 3.0 + 2.0 + 100.0) / (3.0 * kInside));
  EXPECT_DOUBLE_EQ(error.p99, 3.0) << "198 of 200 pixels differ by at most 3";
}

TEST(InsideError, OfEqualPicturesIsZero) {
  const Image<glm::u8vec4> colors(4, 4);
  Image<int> objects(4, 4);
  for (int pass = 0; pass < 2; ++pass) {
    const InsideError error = inside_error({colors, objects}, {colors, objects});
    EXPECT_EQ(error.inside, pass) << "the background is not inside";
    EXPECT_EQ(error.differing, 0);
    EXPECT_EQ(error.mean, 0.0);
    EXPECT_EQ(error.p99, 0.0);
    objects.at(1, 2) = 1;
  }
}

TEST(InsideErrorDeathTest, SizesMustBeEqual) {
  const Image<glm::u8vec4> colors(4, 2);
  const Image<int> objects(4, 2), turned(2, 4);
  EXPECT_DEATH(inside_error({colors, objects}, {colors, turned}), "different sizes");
}

}  // namespace
}  // namespace halfspace
