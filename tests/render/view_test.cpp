// SPDX-License-Identifier: Apache-2.0
//
// Tests cameras that are given by matrices.
#include "halfspace/render/view.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <tuple>

#include "halfspace/core/units.h"
#include "halfspace/geometry/camera.h"
#include "support/errors.h"

namespace halfspace {
namespace {

constexpr int kWidth = 320, kHeight = 200;

CameraDescription plain_camera() {
  CameraDescription c;
  c.position = {2, 3, 4};
  c.target = {-1, 0.5, 0.25};
  c.fov = 50.0;
  c.near = 0.5;
  c.far = 90.0;
  return c;
}

glm::dmat4 world_from_camera(const CameraDescription& c) { return glm::inverse(look_at(c.position, c.target, c.up)); }

// Returns the window coordinates of a point: pixels from the lower left corner, and depth.
glm::dvec3 window_of(const View& v, const glm::dvec3& p) {
  const glm::dvec4 clip = v.clip_from_world * glm::dvec4(p, 1.0);
  return {(clip.x / clip.w + 1.0) * 0.5 * v.width_px, (clip.y / clip.w + 1.0) * 0.5 * v.height_px, clip.z / clip.w};
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance) << "component " << k;
}

void expect_same_view(const View& a, const View& b) {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(a.clip_from_world[i][j], b.clip_from_world[i][j], 1e-12) << i << ", " << j;
  }
  expect_near(a.eye_ws, b.eye_ws, 1e-12);
  expect_near(a.to_eye_ws, b.to_eye_ws, 1e-12);
  expect_near(a.forward_ws, b.forward_ws, 1e-12);
  expect_near(a.ray_ws, b.ray_ws, 1e-12);
  expect_near(a.ray_x_ws, b.ray_x_ws, 1e-12);
  expect_near(a.ray_y_ws, b.ray_y_ws, 1e-12);
  EXPECT_NEAR(a.near, b.near, 1e-12);
  EXPECT_NEAR(a.far, b.far, 1e-9);
  EXPECT_TRUE(a.symmetric && b.symmetric);
}

TEST(MatrixCamera, PerspectiveMatchesThePlainCamera) {
  const CameraDescription c = plain_camera();
  const double aspect = static_cast<double>(kWidth) / kHeight;
  const CameraDescription m = matrix_camera({world_from_camera(c), perspective_gl(c.fov * kRadiansPerDegree, aspect, c.near, c.far)});
  const View a = make_view(m, kWidth, kHeight), b = make_view(c, kWidth, kHeight);
  expect_same_view(a, b);
  EXPECT_NEAR(a.tan_x, b.tan_x, 1e-12);
  EXPECT_NEAR(a.tan_y, b.tan_y, 1e-12);
}

TEST(MatrixCamera, OrthographicMatchesThePlainCamera) {
  CameraDescription c = plain_camera();
  c.type = Projection::orthographic;
  c.height = 3.0;
  const double aspect = static_cast<double>(kWidth) / kHeight;
  const CameraDescription m = matrix_camera({world_from_camera(c), orthographic_gl(c.height, aspect, c.near, c.far)});
  EXPECT_EQ(m.type, Projection::orthographic);
  EXPECT_DOUBLE_EQ(m.height, 3.0);
  const View a = make_view(m, kWidth, kHeight), b = make_view(c, kWidth, kHeight);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(a.clip_from_world[i][j], b.clip_from_world[i][j], 1e-12) << i << ", " << j;
  }
  expect_near(a.to_eye_ws, b.to_eye_ws, 1e-12);
  EXPECT_NEAR(a.tan_y, 1.5, 1e-12);  // half the height
}

TEST(MatrixCamera, RaysOfSkewedOffCenterCamerasGoThroughTheirPixels) {
  const CameraDescription c = plain_camera();
  glm::dmat4 p = perspective_gl(1.0, 1.5, c.near, c.far);
  p[1][0] = 0.2;    // skew
  p[2][0] = 0.37;   // the view axis is left of the center
  p[2][1] = -0.11;  // and above it
  const View v = make_view(matrix_camera({world_from_camera(c), p}), kWidth, kHeight);
  EXPECT_FALSE(v.symmetric);
  for (const glm::dvec2 ndc : {glm::dvec2(0, 0), glm::dvec2(-1, 1), glm::dvec2(0.5, -0.75)}) {
    const glm::dvec3 ray = v.ray_ws + v.ray_x_ws * ndc.x + v.ray_y_ws * ndc.y;
    EXPECT_NEAR(glm::dot(ray, v.forward_ws), 1.0, 1e-12);
    const glm::dvec3 window = window_of(v, v.eye_ws + ray * 7.0);
    EXPECT_NEAR(window.x, (ndc.x + 1.0) * 0.5 * kWidth, 1e-9);
    EXPECT_NEAR(window.y, (ndc.y + 1.0) * 0.5 * kHeight, 1e-9);
  }
}

TEST(MatrixCamera, DepthIsReversed) {
  const CameraDescription c = plain_camera();
  const View v = make_view(matrix_camera({world_from_camera(c), perspective_gl(1.0, 1.5, c.near, c.far)}), kWidth, kHeight);
  EXPECT_NEAR(window_of(v, v.eye_ws + v.forward_ws * c.near).z, 1.0, 1e-12);
  EXPECT_NEAR(window_of(v, v.eye_ws + v.forward_ws * c.far).z, 0.0, 1e-12);
}

TEST(MatrixCamera, AcceptsAnInfiniteFarPlane) {
  glm::dmat4 p = perspective_gl(1.0, 1.5, 0.5, 90.0);
  p[2][2] = -1.0;
  p[3][2] = -2.0 * 0.5;
  const CameraDescription c = matrix_camera({glm::dmat4(1.0), p});
  EXPECT_DOUBLE_EQ(c.near, 0.5);
  EXPECT_EQ(c.far, kFarthest);
}

TEST(MatrixCamera, RejectsOtherMatrices) {
  const glm::dmat4 identity(1.0), perspective = perspective_gl(1.0, 1.5, 0.5, 90.0);
  const auto changed = [](glm::dmat4 m, int column, int row, double value) {
    m[column][row] = value;
    return m;
  };
  const auto message = [](const glm::dmat4& world, const glm::dmat4& clip) { return input_error([&] { matrix_camera({world, clip}); }); };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(message(changed(identity, 3, 0, nan), perspective).starts_with("camera: a matrix is not finite"));
  EXPECT_TRUE(message(identity, changed(perspective, 0, 0, nan)).starts_with("camera: a matrix is not finite"));
  EXPECT_TRUE(message(changed(identity, 0, 0, 1.01), perspective).starts_with("camera: the pose is not a rotation"));
  EXPECT_TRUE(message(changed(identity, 0, 0, -1.0), perspective).starts_with("camera: the pose is not a rotation"));
  EXPECT_TRUE(message(changed(identity, 0, 3, 0.5), perspective).starts_with("camera: the pose is not a rotation"));
  for (const auto& [column, row, value] : {std::tuple{2, 3, 1.0}, {0, 2, 0.1}, {3, 0, 0.1}, {0, 0, -1.0}, {0, 0, 0.0}, {3, 2, 1.0}}) {
    EXPECT_TRUE(message(identity, changed(perspective, column, row, value)).starts_with("camera: the projection matrix"))
        << column << ", " << row;
  }
}

TEST(Placement, MatrixReplacesAllOtherMembers) {
  glm::dmat4 m(1.0);
  m[1][0] = 0.5;
  EXPECT_EQ(world_from_object({.position = {1, 2, 3}, .matrix = m}), m);
}

}  // namespace
}  // namespace halfspace
