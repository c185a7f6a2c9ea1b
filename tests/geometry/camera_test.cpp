// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/constants.h"

namespace halfspace {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec3 divided(const glm::dvec4& clip) { return glm::dvec3(clip.x, clip.y, clip.z) / clip.w; }
double depth(const glm::dmat4& m, double z) { return divided(m * glm::dvec4(0, 0, z, 1)).z; }

TEST(Camera, LookAtMovesTheEyeToTheOriginAndTheTargetToMinusZ) {
  const glm::dvec3 eye(3, 4, 5), target(-1, 2, 0.5);
  const glm::dmat4 v = look_at(eye, target, {0, 1, 0});
  const glm::dvec4 e = v * glm::dvec4(eye, 1);
  const glm::dvec4 t = v * glm::dvec4(target, 1);
  EXPECT_NEAR(glm::length(glm::dvec3(e.x, e.y, e.z)), 0, 1e-14);
  EXPECT_NEAR(t.x, 0, 1e-14);
  EXPECT_NEAR(t.y, 0, 1e-14);
  EXPECT_NEAR(t.z, -glm::length(target - eye), 1e-14);
  const glm::dvec4 up = v * glm::dvec4(0, 1, 0, 0);
  EXPECT_NEAR(up.x, 0, 1e-15);
  EXPECT_GT(up.y, 0);
  EXPECT_NEAR(glm::determinant(v), 1, 1e-14) << "right-handed: a rotation without reflection";
}

TEST(Camera, LookAtFromPlusZIsATranslation) {
  // +x remains on the right and +y up.
  const glm::dmat4 v = look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0});
  const glm::dvec4 p = v * glm::dvec4(1, 2, 3, 1);
  EXPECT_EQ(p, glm::dvec4(1, 2, 1, 1));
}

TEST(Camera, PerspectiveCoversTheFieldOfView) {
  for (const glm::dmat4& m : {perspective_gl(kPi / 2, 2.0, 1, 10), perspective_reversed(kPi / 2, 2.0, 1, 10)}) {
    // A field of view of 90° at distance 3: y = ±3 at the edge, and x = ±6 for an aspect ratio of 2.
    const glm::dvec3 corner = divided(m * glm::dvec4(6, 3, -3, 1));
    EXPECT_NEAR(corner.x, 1, 1e-15);
    EXPECT_NEAR(corner.y, 1, 1e-15);
    EXPECT_EQ((m * glm::dvec4(6, 3, -3, 1)).w, 3) << "clip w is the distance along the view axis";
  }
}

TEST(Camera, GlDepthIsMinusOneAtNearAndOneAtFar) {
  const glm::dmat4 m = perspective_gl(1, 1, 0.25, 80);
  EXPECT_NEAR(depth(m, -0.25), -1, 1e-14);
  EXPECT_NEAR(depth(m, -80), 1, 1e-14);
  EXPECT_NEAR(depth(m, -2), (80 + 0.25) / (80 - 0.25) - 2 * 80 * 0.25 / ((80 - 0.25) * 2), 1e-14);
}

TEST(Camera, ReversedDepthIsOneAtNearAndZeroAtFar) {
  const glm::dmat4 m = perspective_reversed(1, 1, 0.25, 80);
  EXPECT_NEAR(depth(m, -0.25), 1, 1e-14);
  EXPECT_NEAR(depth(m, -80), 0, 1e-16);
  EXPECT_NEAR(depth(m, -2), 0.25 * (80.0 / 2 - 1) / (80 - 0.25), 1e-15);
}

TEST(Camera, InfiniteReversedDepthIsNearOverDistance) {
  const glm::dmat4 m = perspective_reversed(1, 1, 0.25, kInfinity);
  EXPECT_EQ(depth(m, -0.25), 1);
  EXPECT_EQ(depth(m, -1e6), 0.25 / 1e6);
  EXPECT_NEAR(depth(m, -3), depth(perspective_reversed(1, 1, 0.25, 1e12), -3), 1e-12) << "the limit for large far distances";
}

TEST(Camera, FloatReversedDepthIsExactAtTheNearPlane) {
  // If near is a power of two, every element of the row is representable as a float.
  const glm::mat4 m(perspective_reversed(1, 1, 0.125, kInfinity));
  const glm::vec4 near = m * glm::vec4(0, 0, -0.125f, 1);
  EXPECT_EQ(near.z / near.w, 1.0f);
}

TEST(Camera, OrthographicMapsTheViewVolume) {
  const glm::dmat4 gl = orthographic_gl(4, 1.5, 1, 9);
  const glm::dmat4 reversed = orthographic_reversed(4, 1.5, 1, 9);
  EXPECT_EQ(divided(gl * glm::dvec4(3, 2, -1, 1)), glm::dvec3(1, 1, -1));
  EXPECT_EQ(divided(gl * glm::dvec4(-3, -2, -9, 1)), glm::dvec3(-1, -1, 1));
  EXPECT_EQ(divided(reversed * glm::dvec4(3, 2, -1, 1)), glm::dvec3(1, 1, 1));
  EXPECT_EQ(divided(reversed * glm::dvec4(0, 0, -9, 1)), glm::dvec3(0, 0, 0));
}

TEST(Camera, BrokenPreconditionsAbort) {
  EXPECT_DEATH(perspective_gl(1, 1, 1, kInfinity), "far plane is infinitely far");
  EXPECT_DEATH(perspective_gl(4, 1, 1, 2), "angle of view is too large");
  EXPECT_DEATH(perspective_reversed(1, 1, 0, 2), "near plane is not in front of the eye.*\\(0 vs 0\\)");
  EXPECT_DEATH(look_at({1, 1, 1}, {1, 1, 1}, {0, 1, 0}), "eye is the target, or up is parallel");
  EXPECT_DEATH(look_at({0, 0, 0}, {0, 1, 0}, {0, 1, 0}), "eye is the target, or up is parallel");
}

}  // namespace
}  // namespace halfspace
