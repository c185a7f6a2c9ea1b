// SPDX-License-Identifier: Apache-2.0
//
// Compares normals from normal maps and height maps with their expected values.
#include "halfspace/shading/surface/surface_detail.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/constants.h"

namespace halfspace {
namespace {

// A float map with a single texel, which stores the value exactly.
Texture2D texel(const glm::vec3& c) {
  Image<glm::vec4> image(1, 1);
  image.at(0, 0) = glm::vec4(c, 1);
  return {image, TexelFormat::rgba32f};
}

constexpr glm::vec3 kNormal(0, 0, 1), kTangent(1, 0, 0);
const MapCoordinates<float> kPlace{glm::vec2(0.5f), glm::vec2(0.0f), glm::vec2(0.0f)};

glm::vec3 mapped(const glm::vec3& code, DetailMap detail = {}, const glm::vec3& n = kNormal, const glm::vec3& t = kTangent,
                 float side = 1) {
  const Texture2D map = texel(code);
  detail.map = &map;
  return normal_from_map<float>(detail, kPlace, n, t, side);
}

TEST(NormalMap, AxesAreTangentAndBitangent) {
  EXPECT_EQ(mapped({0.5f, 0.5f, 1}), glm::vec3(0, 0, 1)) << "flat";
  EXPECT_EQ(mapped({1, 0.5f, 0.5f}), glm::vec3(1, 0, 0)) << "red tilts along the tangent";
  EXPECT_EQ(mapped({0.5f, 1, 0.5f}), glm::vec3(0, 1, 0)) << "green tilts along cross(normal, tangent)";
  EXPECT_EQ(mapped({0.5f, 1, 0.5f}, {}, kNormal, kTangent, -1), glm::vec3(0, -1, 0)) << "mirrored";
  EXPECT_EQ(mapped({0.5f, 1, 0.5f}, {.flip_green = true}), glm::vec3(0, -1, 0));
  EXPECT_EQ(mapped({1, 0.5f, 0.5f}, {.flip_green = true}), glm::vec3(1, 0, 0));
}

TEST(NormalMap, StrengthScalesTheTilt) {
  EXPECT_EQ(mapped({0.75f, 0.25f, 1}, {.strength = 1}), glm::vec3(0.5f, -0.5f, 1));
  EXPECT_EQ(mapped({0.75f, 0.25f, 1}, {.strength = 3}), glm::vec3(1.5f, -1.5f, 1));
  EXPECT_EQ(mapped({0.75f, 0.25f, 1}, {.strength = 0}), glm::vec3(0, 0, 1));
}

TEST(NormalMap, FrameIsUsedAsInterpolated) {
  // The frame is not normalized: a frame of half the length gives a vector of half the length (MikkTSpace).
  EXPECT_EQ(mapped({0.75f, 0.5f, 1}, {}, {0, 0, 0.5f}, {0.5f, 0, 0}), glm::vec3(0.25f, 0, 0.5f));
}

TEST(NormalMap, DegenerateInputKeepsTheNormal) {
  for (const glm::vec3& code : {glm::vec3(0.5f), glm::vec3(0.9f, 0.1f, 0.7f), glm::vec3(0.0f), glm::vec3(1.0f)}) {
    const glm::vec3 n = mapped(code, {}, kNormal, glm::vec3(0.0f));
    EXPECT_EQ(glm::normalize(n), kNormal) << "zero tangent";
    EXPECT_TRUE(std::isfinite(mapped(code, {}, glm::vec3(0.0f), glm::vec3(0.0f)).x)) << "zero frame";
  }
  EXPECT_EQ(mapped({0.5f, 0.5f, 0}), kNormal) << "a texel that points inward";
}

TEST(Heights, TiltAPlaneByItsSlope) {
  // The steps to the right and up are skewed and have different lengths. The height rises along x by 0.3 and falls along y by 0.2 per unit,
  // so the normal is (-0.3, 0.2, 1).
  const glm::dvec3 dp_dx(0.03, 0.01, 0), dp_dy(-0.02, 0.05, 0);
  const auto rise = [](const glm::dvec3& step) { return 0.3 * step.x - 0.2 * step.y; };
  const vec3<double> n = normal_from_heights<double>({0, 0, 1}, {rise(dp_dx), rise(dp_dy)}, dp_dx, dp_dy);
  EXPECT_NEAR(n.x, -0.3, 1e-14);
  EXPECT_NEAR(n.y, 0.2, 1e-14);
  EXPECT_EQ(n.z, 1.0);
  // Seen from below, the steps have the opposite orientation, as in a mirror, but the surface is the same.
  const vec3<double> m = normal_from_heights<double>({0, 0, 1}, {rise(dp_dy), rise(dp_dx)}, dp_dy, dp_dx);
  EXPECT_NEAR(length(m - n), 0, 1e-14);
}

TEST(Heights, HandlesAnyStepSizeAndGrazingSurfaces) {
  for (const float size : {1e-12f, 1e-6f, 1.0f, 1e6f}) {
    const glm::vec3 n = normal_from_heights<float>({0, 0, 1}, {0.5f * size, 0}, {size, 0, 0}, {0, size, 0});
    EXPECT_FLOAT_EQ(n.x, -0.5f) << size;
    EXPECT_EQ(n.z, 1.0f);
  }
  EXPECT_EQ(normal_from_heights<float>({0, 0, 1}, {0.5f, 0.5f}, glm::vec3(0.0f), glm::vec3(0.0f)), kNormal) << "zero steps";
  EXPECT_EQ(normal_from_heights<float>({0, 0, 1}, {0.0f, 0.0f}, {1, 0, 0}, {2, 0, 0}), kNormal) << "edge-on";
}

TEST(Heights, StepsAreTheSlopeAlongThePixelAxes) {
  Image<glm::vec4> slopes(1, 1);
  slopes.at(0, 0) = {8, -4, 0, 0};
  const Texture2D map(slopes, TexelFormat::rgba32f);
  const DetailMap detail{.map = &map, .strength = 0.5f};
  const HeightSteps<double> h = height_steps<double>(detail, {vec2<double>(0.5), vec2<double>(0.01, 0.02), vec2<double>(-0.03, 0.04)});
  EXPECT_NEAR(h.right, 0.5 * (8 * 0.01 - 4 * 0.02), 1e-15);
  EXPECT_NEAR(h.up, 0.5 * (8 * -0.03 - 4 * 0.04), 1e-15);
}

TEST(SurfaceDetail, SlopesTiltTheSphereNormal) {
  // The reference evaluates the frame at (u, v) in double; the shader derives the same frame from n only.
  for (int i = 1; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      const double v = i / 20.0, u = j / 20.0 + 0.013;
      const double s = std::sin(kPi * v), c = std::cos(kPi * v), su = std::sin(2 * kPi * u), cu = std::cos(2 * kPi * u);
      const glm::dvec3 n(s * cu, c, -s * su), east(-su, 0, -cu), north(-c * cu, s, c * su);
      const glm::dvec3 slope(0.3 - 0.02 * i, 0.04 * j - 0.4, 1.02);
      const glm::dvec3 want = n * slope.z - east * slope.x - north * slope.y;
      const vec3<double> got = normal_from_slopes<double>(n, slope);
      EXPECT_LT(length(got - want), 1e-14);
      const vec3<float> single = normal_from_slopes<float>(glm::vec3(n), glm::vec3(slope));
      EXPECT_LT(glm::length(glm::dvec3(single) - want), 1e-6);  // n rounded to float, divided by a ring radius of at least 0.15
    }
  }
  EXPECT_EQ(normal_from_slopes<float>({0, 1, 0}, {0.5f, 0.5f, 1}), glm::vec3(0, 1, 0)) << "the east direction is undefined at a pole";
}

}  // namespace
}  // namespace halfspace
