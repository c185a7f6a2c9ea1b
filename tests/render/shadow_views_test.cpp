// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/shadow/shadow_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "halfspace/geometry/camera.h"

namespace halfspace {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

glm::dvec3 to_texels(const LightView& view, int size, const glm::dvec3& p_ws) {
  const glm::dvec4 clip = view.clip_from_world * glm::dvec4(p_ws, 1.0);
  const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
  return {(ndc.x + 1.0) * 0.5 * size, (ndc.y + 1.0) * 0.5 * size, ndc.z};
}

Box box_of(std::initializer_list<glm::dvec3> points) {
  Box b;
  for (const glm::dvec3& p : points) b.add(p);
  return b;
}

TEST(ShadowViews, AxesFormARightHandedFrameAlongTheLight) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 to_light(normal(random), normal(random), normal(random));
    const glm::dmat3 axes = light_axes(to_light);
    EXPECT_NEAR(glm::determinant(axes), 1.0, 1e-12);  // rounding of a few values near 1
    EXPECT_NEAR(glm::dot(axes[2], glm::normalize(to_light)), 1.0, 1e-12);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < a; ++b) EXPECT_NEAR(glm::dot(axes[a], axes[b]), 0.0, 1e-12);
  }
  EXPECT_NEAR(glm::determinant(light_axes({0, 1, 0})), 1.0, 1e-12);  // straight down
}

TEST(ShadowViews, DirectionalViewContainsReceiversAndCasterDepths) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-50.0, 50.0);
  for (int i = 0; i < 200; ++i) {
    const glm::dmat3 axes = light_axes({any(random), any(random), any(random)});
    const auto corner = [&] { return glm::dvec3(any(random), any(random), any(random)); };
    const Box receivers = box_of({corner(), corner()}), casters = box_of({corner(), corner()});
    const int size = 512;
    const LightView view = directional_view(axes, receivers, {&casters, 1}, size, 4.0);
    for (const glm::dvec3& c : corners_of(receivers)) {
      const glm::dvec3 p = to_texels(view, size, axes * c);
      EXPECT_GE(std::min(p.x, p.y), 4.0);
      EXPECT_LE(std::max(p.x, p.y), size - 4.0);
      EXPECT_GT(p.z, 0.0);
    }
    for (const glm::dvec3& c : corners_of(casters)) {
      const glm::dvec3 p = to_texels(view, size, axes * c);
      const bool over = p.x >= 0.0 && p.x <= size && p.y >= 0.0 && p.y <= size;
      EXPECT_TRUE(!over || p.z < 1.0);  // even where no receiver is below it, because other points of the square look up the map there
    }
  }
}

// The view is square and therefore wider than a long strip of receivers. It also contains points next to the strip, which can receive
// shadows from casters above them.
TEST(ShadowViews, DirectionalViewContainsCastersOverItsWholeSquare) {
  const glm::dmat3 axes = light_axes({0, 0, 1});
  const Box strip = box_of({{-5, -0.1, -1}, {5, 0.1, 0}}), beside = box_of({{-1, 3, 6}, {1, 4, 7}}),
            apart = box_of({{20, 0, 50}, {21, 1, 60}});
  const Box casters[] = {strip, beside, apart};
  const LightView view = directional_view(axes, strip, casters, 512, 4.0);
  const double depth = to_texels(view, 512, axes * beside.high).z;
  EXPECT_LT(depth, 1.0);
  EXPECT_GT(depth, 0.9);  // casters outside the square do not extend the depth range
}

TEST(ShadowViews, DepthAndTexelScalesMatchTheView) {
  const glm::dmat3 axes = light_axes({1, 2, 3});
  const Box receivers = box_of({{-3, -2, -1}, {2, 3, 4}});
  const LightView view = directional_view(axes, receivers, {&receivers, 1}, 256, 2.0);
  const glm::dvec3 p(0.3, 0.2, 0.1);
  const glm::dvec3 here = to_texels(view, 256, p);
  EXPECT_NEAR(to_texels(view, 256, p + axes[0] * view.texel_per_w).x - here.x, 1.0, 1e-9);
  EXPECT_NEAR(to_texels(view, 256, p + axes[2]).z - here.z, view.depth_per_unit, 1e-12);

  const LightView spot = spot_view({1, 2, 3}, {0, -1, 0}, 60.0 * kDegree, 0.5, 20.0, 256, 2.0);
  const double w = 4.0, step = 1e-6;
  const glm::dvec3 q = glm::dvec3(1, 2 - w, 3);
  EXPECT_NEAR((to_texels(spot, 256, q + glm::dvec3(0, step, 0)).z - to_texels(spot, 256, q).z) / step, spot.depth_per_unit / (w * w),
              1e-6);  // curvature over the step
  EXPECT_NEAR(glm::length(to_texels(spot, 256, q + glm::dvec3(spot.texel_per_w * w, 0, 0)) - to_texels(spot, 256, q)), 1.0, 1e-9);
  EXPECT_NEAR(to_texels(spot, 256, {1, 1.5, 3}).z, 1.0, 1e-12);
  EXPECT_NEAR(to_texels(spot, 256, {1, -18, 3}).z, 0.0, 1e-12);
}

TEST(ShadowViews, CameraMotionKeepsTheTexelGrid) {
  const glm::dmat3 axes = light_axes({1, 5, 2});
  const Box casters = box_of({{-9, -9, -9}, {9, 9, 9}});
  const auto at = [&](double shift) {
    return directional_view(axes, box_of({{shift, shift, -1}, {shift + 6.1, shift + 6.1, 1}}), {&casters, 1}, 1024, 2.0);
  };
  const LightView first = at(0.0);
  for (double shift = 0.0; shift < 1.0; shift += 0.0137) {
    const LightView view = at(shift);
    EXPECT_EQ(view.texel_per_w, first.texel_per_w);
    const glm::dvec3 moved = to_texels(view, 1024, {0, 0, 0}) - to_texels(first, 1024, {0, 0, 0});
    // A texel is 6e-3 units wide and coordinates are below 10, so products are rounded at the 13th digit.
    EXPECT_NEAR(moved.x, std::round(moved.x), 1e-8);
    EXPECT_NEAR(moved.y, std::round(moved.y), 1e-8);
  }
}

TEST(ShadowViews, CubeFacesCoverAllDirectionsAndOverlapByTheMargin) {
  const glm::dvec3 light(0.5, -2, 7);
  const int size = 128;
  const double margin = 4.5;
  const auto views = cube_views(light, 0.1, 100.0, size, margin);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec3 p = light + 5.0 * glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    int holding = 0;
    for (const LightView& view : views) {
      const glm::dvec4 clip = view.clip_from_world * glm::dvec4(p, 1.0);
      const glm::dvec3 t = to_texels(view, size, p);
      const double low = margin - 1e-9, high = size - margin + 1e-9;  // points on the edge of a face belong to both faces
      holding += clip.w > 0 && t.x >= low && t.x <= high && t.y >= low && t.y <= high;
    }
    EXPECT_GE(holding, 1);
  }
}

TEST(ShadowViews, CommonCornersAreThoseOfTheIntersection) {
  const glm::dmat4 clip = perspective_reversed(60.0 * kDegree, 1.5, 1.0, 50.0) * look_at({0, 0, 10}, {0, 0, 0}, {0, 1, 0});
  const auto frustum = frustum_corners(clip);
  EXPECT_NEAR(frustum[0].z, 9.0, 1e-9);
  EXPECT_NEAR(frustum[4].z, -40.0, 1e-9);
  // A box inside the frustum gives its own corners, a box around the frustum gives the corners of the frustum, and a box behind the eye
  // gives none.
  const auto span_of = [](const std::vector<glm::dvec3>& corners) {
    Box b;
    for (const glm::dvec3& p : corners) b.add(p);
    return b;
  };
  const Box inside = span_of(common_corners(frustum, box_of({{-1, -1, -1}, {1, 1, 1}})));
  EXPECT_LT(glm::length(inside.low + glm::dvec3(1)) + glm::length(inside.high - glm::dvec3(1)), 1e-12);
  const Box around = span_of(common_corners(frustum, box_of({{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}})));
  EXPECT_NEAR(around.low.z, -40.0, 1e-9);
  EXPECT_NEAR(around.high.z, 9.0, 1e-9);
  EXPECT_TRUE(common_corners(frustum, box_of({{-1, -1, 11}, {1, 1, 12}})).empty());
  // A slab across the frustum: every corner is inside both, and the planes of the slab are reached.
  const auto across = common_corners(frustum, box_of({{-1e3, -1e3, 0}, {1e3, 1e3, 2}}));
  const Box slab = span_of(across);
  EXPECT_NEAR(slab.high.z - slab.low.z, 2.0, 1e-9);
  EXPECT_NEAR(slab.high.y, 10.0 * std::tan(30.0 * kDegree), 1e-9);  // at z = 0
}

TEST(ShadowViews, CascadeSplitsRangeFromUniformToLogarithmic) {
  const std::vector<double> even = cascade_splits(1.0, 81.0, 4, 0.0), geometric = cascade_splits(1.0, 81.0, 4, 1.0);
  for (int i = 0; i <= 4; ++i) {
    EXPECT_NEAR(even[static_cast<std::size_t>(i)], 1.0 + 20.0 * i, 1e-9);
    EXPECT_NEAR(geometric[static_cast<std::size_t>(i)] / std::pow(3.0, i), 1.0, 1e-6);  // pow is evaluated in float
  }
}

}  // namespace
}  // namespace halfspace
