// SPDX-License-Identifier: Apache-2.0
//
// Tests the polygon offset of triangles that are drawn as outlines or as points, against the formula of OpenGL 4.6, section 14.6.5.
#include <cmath>

#include "raster/raster_test.h"

namespace halfspace::raster_test::outline_offset_test {
namespace {

constexpr int kSize = 64;

// Window depths of a triangle whose depth changes by 1/256 per pixel in x and by 1/512 in y.
Image<float> depths(PolygonMode mode, const DepthOffset& offset, int samples, bool clipped) {
  const auto corner = [](int x, int y) {
    const float z = 0.25f + static_cast<float>(x) / 256.0f + static_cast<float>(y) / 512.0f;
    return clip_position({x * 256 + 128, y * 256 + 128}, kSize, kSize, 2.0f * z - 1.0f);
  };
  // The clipped triangle reaches beyond the far plane (x > 192).
  const std::vector<glm::vec4> positions{corner(4, 4), corner(clipped ? 1024 : 52, 4), corner(4, 52)};
  Image<float> depth(kSize, kSize);
  Pass pass(kSize, kSize, std::span<const ColorTarget>{}, d32f_target(depth), {.samples = samples});
  pass.draw_depth(PositionShader{}, make_vertex_view(stream(positions)), {.point_size = 3.0f, .polygon_mode = mode, .offset = offset});
  pass.run(one_worker());
  return depth;
}

void expect_moved(PolygonMode mode, const DepthOffset& offset, double expected) {
  for (const int samples : {1, 4}) {
    for (const bool clipped : {false, true}) {
      const Image<float> before = depths(mode, {}, samples, clipped), after = depths(mode, offset, samples, clipped);
      int drawn = 0;
      for (int i = 0; i < kSize * kSize; ++i) {
        const auto from = static_cast<double>(before.data()[i]), to = static_cast<double>(after.data()[i]);
        if (from == 1.0) continue;
        ++drawn;
        // The depths of the corners are below 1 and are rounded, and so is each sum: 3 times half a unit of 2^-24. The slope is that of
        // rounded positions and depths.
        EXPECT_NEAR(to - from, expected, 3 * 0x1p-24 + std::abs(expected) * 1e-5) << i;
      }
      EXPECT_GT(drawn, mode == PolygonMode::line ? 50 : 15);
    }
  }
}

TEST(OutlineOffset, FollowsTheFormula) {
  const double slope = 1.0 / 256.0;  // the larger of the two derivatives
  expect_moved(PolygonMode::line, {.slope = -4.0f, .outlines = true}, -4.0 * slope);
  expect_moved(PolygonMode::point, {.slope = -4.0f, .corners = true}, -4.0 * slope);
  expect_moved(PolygonMode::line, {.slope = 2.0f, .clamp = 0.001f, .outlines = true}, 0.001);
}

TEST(OutlineOffset, AppliesToTheModesThatTheStateNames) {
  constexpr DepthOffset kOthers{.slope = -4.0f, .fill = false};
  for (const PolygonMode mode : {PolygonMode::fill, PolygonMode::line, PolygonMode::point}) expect_moved(mode, kOthers, 0.0);
  expect_moved(PolygonMode::line, {.slope = -4.0f, .corners = true}, 0.0);
  expect_moved(PolygonMode::point, {.slope = -4.0f, .outlines = true}, 0.0);
  expect_moved(PolygonMode::fill, {.slope = -4.0f}, -4.0 / 256.0);
}

// With float depths, the smallest resolvable difference depends on the exponent of the largest depth of the triangle.
TEST(OutlineOffset, ConstantsAreUnitsOfTheLargestDepth) {
  const Image<float> before = depths(PolygonMode::line, {}, 1, false);
  const Image<float> after = depths(PolygonMode::line, {.constant = 1024.0f, .outlines = true}, 1, false);
  for (int i = 0; i < kSize * kSize; ++i) {
    if (before.data()[i] == 1.0f) continue;
    // Depths are between 1/4 and 1/2, so the unit is 2^(-2 - 23). The sum is rounded to 2^-25.
    EXPECT_NEAR(static_cast<double>(after.data()[i]) - static_cast<double>(before.data()[i]), 1024 * 0x1p-25, 2 * 0x1p-25);
  }
}

}  // namespace
}  // namespace halfspace::raster_test::outline_offset_test
