// SPDX-License-Identifier: Apache-2.0
//
// The precision of depth with reversed Z in float does not depend on the near and far planes, so a camera can have some that cut off
// nothing. Distances that are computed from the depth of a plain of 100 km, seen from a height of 2 m, are compared with a closed form.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "halfspace/geometry/camera.h"
#include "halfspace/raster/pass.h"
#include "halfspace/render/shadow/shadow_views.h"
#include "halfspace/render/view.h"
#include "support/shaders.h"

namespace halfspace {
namespace {

constexpr double kFar = 1e5, kHeight = 2.0;
constexpr int kWidth = 32, kRows = 480;
struct Planes {
  double near, far;
};
// The first two are those of near_plane() and far_plane(). A near plane of 1 m already cuts off the plain in the lowest rows of wider
// views.
const std::vector<Planes> kPlanes{{0x1p-30, kFarthest}, {0x1p-40 * kFar, kFar}, {1e-6, kFar}, {1e-3, kFar}, {0.1, kFar}, {1.0, kFar}};

double tan_y() { return std::tan(std::numbers::pi / 6.0); }
glm::dmat4 projection(const Planes& p) {
  return perspective_reversed(std::numbers::pi / 3.0, static_cast<double>(kWidth) / kRows, p.near, p.far);
}

// Returns the corners of a rectangle in view space as two triangles in clip space.
std::vector<glm::vec4> in_clip_space(const Planes& planes, const std::array<glm::vec3, 4>& corner) {
  std::vector<glm::vec4> out;
  for (const std::size_t i : {0u, 1u, 2u, 0u, 2u, 3u}) out.push_back(glm::mat4(projection(planes)) * glm::vec4(corner[i], 1.0f));
  return out;
}

// Returns the distance along the view axis that a depth stands for.
double distance_of(double depth, const Planes& p) {
  const double a = p.near / (p.far - p.near);
  return p.far * a / (depth + a);
}

TEST(NearPlane, TheDepthErrorOfAPlainDoesNotDependOnIt) {
  const auto edge = static_cast<float>(2 * kFar);
  const float y = -static_cast<float>(kHeight);
  for (const Planes& planes : kPlanes) {
    Image<float> depth(kWidth, kRows);
    Pass pass(kWidth, kRows, ColorTarget{}, d32f_target(depth, 0.0f));
    const std::vector<glm::vec4> plain = in_clip_space(planes, {{{-edge, y, edge}, {edge, y, edge}, {edge, y, -edge}, {-edge, y, -edge}}});
    pass.draw_depth(ConstantShader{}, make_vertex_view(stream(plain)), kReversedZState);
    pass.run(Workers(1));
    double worst_rows = 0.0;
    int seen = 0;
    for (int row = kRows / 2; row < kRows; ++row) {
      const double slope = tan_y() * (2.0 * (row + 0.5) / kRows - 1.0), distance = kHeight / slope;  // closed form
      const double found = distance_of(static_cast<double>(depth.at(kWidth / 2, row)), planes);
      // A difference of 1/distance, in rows.
      worst_rows = std::max(worst_rows, std::fabs(1.0 / found - 1.0 / distance) * kHeight / tan_y() * kRows / 2.0);
      if (row % 24 == 0 || row == kRows - 1 || row == kRows / 2)
        RecordProperty("near_" + std::to_string(planes.near) + "_at_" + std::to_string(distance), std::to_string(found / distance - 1.0));
      ++seen;
    }
    EXPECT_EQ(seen, kRows / 2);
    // Vertices are snapped to 1/256 px, an error of at most 1/512 px along either axis, which moves the plain by at most 1/256 row. The 8
    // ulp of rounding, relative to 1/distance, are at most 8 · 2^-24 · 240 rows, which is less than 1/4096.
    EXPECT_LT(worst_rows, 1.0 / 256.0 + 1.0 / 4096.0) << planes.near;
  }
}

// Returns the fraction of pixels in which the surface at `distance` hides one that is farther by `gap`, if it is drawn first or second.
double hidden(const Planes& planes, double distance, double gap, bool first) {
  Image<glm::vec4> picture(kWidth, kRows);
  Pass pass(kWidth, kRows, rgba32f_target(picture), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  std::array<std::vector<glm::vec4>, 2> walls;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto z = static_cast<float>(-distance * (i == 0 ? 1.0 : 1.0 + gap)), half = static_cast<float>(distance);
    walls[i] = in_clip_space(planes, {{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}}});
  }
  for (const std::size_t i : {first ? 0u : 1u, first ? 1u : 0u})
    pass.draw(ConstantShader{i == 0 ? glm::vec4(1) : glm::vec4(0, 0, 0, 1)}, make_vertex_view(stream(walls[i])), kReversedZState);
  pass.run(Workers(1));
  int correct = 0;
  for (const glm::vec4& c : picture.texels()) correct += c.x == 1.0f;
  return static_cast<double>(correct) / static_cast<double>(picture.texels().size());
}

TEST(NearPlane, SurfacesThatDifferByAMillionthAreInOrder) {
  // Each depth has about four roundings of 2^-24 relative to itself: two depths differ correctly if the gap exceeds 8 · 2^-24 = 4.8e-7.
  // Close to the far plane the depth approaches 0, so that the gap is even larger in terms of its ulp.
  for (const Planes& planes : kPlanes)
    for (const double distance : {1.5, 10.0, 400.0, 2e4, 9e4})
      for (const bool first : {true, false})
        EXPECT_EQ(hidden(planes, distance, 1e-6, first), 1.0) << planes.near << ' ' << distance << ' ' << first;
}

TEST(NearPlane, IsAutomaticOnlyIfTheCameraHasNone) {
  CameraDescription c;
  c.far = 1000.0;
  EXPECT_EQ(near_plane(c), 0x1p-40 * 1000.0);
  EXPECT_EQ(make_view(c, 64, 64).near, near_plane(c));
  c.type = Projection::orthographic;
  EXPECT_EQ(near_plane(c), 0.0);
  EXPECT_EQ(make_view(c, 64, 64).near, 0.0);
  for (const Projection type : {Projection::perspective, Projection::orthographic}) {
    c.type = type;
    c.near = 0.25;
    EXPECT_EQ(near_plane(c), 0.25);
  }
}

TEST(NearPlane, TheFarPlaneIsAutomaticOnlyIfTheCameraHasNone) {
  CameraDescription c;
  EXPECT_EQ(far_plane(c), kFarthest);
  EXPECT_EQ(near_plane(c), 0x1p-30);
  EXPECT_EQ(make_view(c, 64, 64).far, kFarthest);
  c.type = Projection::orthographic;
  c.near = 3.0;
  EXPECT_EQ(far_plane(c), 1003.0);
  c.far = 20.0;
  EXPECT_EQ(far_plane(c), 20.0);
  // A projection whose far plane is at infinity.
  CameraMatrices matrices;
  matrices.clip_from_camera = glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -0.5, 0);
  EXPECT_EQ(matrix_camera(matrices).far, kFarthest);
  EXPECT_EQ(matrix_camera(matrices).near, 0.25);
}

TEST(NearPlane, TheCornersOfTheFrustumAreExact) {
  CameraDescription c;
  c.position = {3, -2, 7};
  c.target = {1, 5, -4};
  for (const double far : {0.0, 100.0}) {
    c.far = far;
    const View view = make_view(c, 160, 90);
    const std::array<glm::dvec3, 8> corners = frustum_corners(view);
    for (std::size_t i = 0; i < 8; ++i) {
      const double distance = (i & 4) != 0 ? view.far : view.near;
      const glm::dvec3 from_eye = (corners[i] - view.eye_ws) / distance;
      // The eye is subtracted again: the rounding of a position of length 8, relative to the distance.
      const double tolerance = 1e-14 + 1e-15 / distance;
      EXPECT_NEAR(glm::dot(from_eye, view.forward_ws), 1.0, tolerance);
      EXPECT_NEAR(glm::dot(from_eye, view.right_ws), (i & 1) != 0 ? view.tan_x : -view.tan_x, tolerance);
      EXPECT_NEAR(glm::dot(from_eye, view.up_ws), (i & 2) != 0 ? view.tan_y : -view.tan_y, tolerance);
    }
  }
}

}  // namespace
}  // namespace halfspace
