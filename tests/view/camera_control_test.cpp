// SPDX-License-Identifier: Apache-2.0
#include "view/camera_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "halfspace/render/view.h"

namespace halfspace {
namespace {

constexpr double kRounding = 1e-12;  // a few operations in double on numbers around 1

CameraDescription sample_camera() {
  CameraDescription c;
  c.position = {1, 2, 6};
  c.target = {0.5, 0.5, 0};
  c.fov = 40;
  return c;
}

double distance_of(const CameraDescription& c) { return glm::distance(c.position, c.target); }

glm::dvec2 window_of(const CameraDescription& c, const glm::dvec3& point) {
  const glm::dvec4 clip = make_view(c, 640, 480).clip_from_world * glm::dvec4(point, 1.0);
  return {(clip.x / clip.w * 0.5 + 0.5) * 640, (0.5 - clip.y / clip.w * 0.5) * 480};
}

TEST(CameraControl, AStepForwardIsAFractionOfTheDistance) {
  CameraDescription c = sample_camera();
  const double distance = distance_of(c);
  move_camera(c, {0, 0, 0.25});
  EXPECT_NEAR(glm::distance(c.position, sample_camera().position), 0.25 * distance, kRounding);
  EXPECT_NEAR(distance_of(c), distance, kRounding);
  EXPECT_NEAR(glm::distance(c.position, sample_camera().target), 0.75 * distance, kRounding);
}

TEST(CameraControl, AStepToTheRightMovesThePictureToTheLeft) {
  CameraDescription c = sample_camera();
  move_camera(c, {0.1, 0, 0});
  EXPECT_LT(window_of(c, sample_camera().target).x, 320.0);
  EXPECT_NEAR(window_of(c, sample_camera().target).y, 240.0, 1e-9);
}

TEST(CameraControl, TurningKeepsThePositionAndOrbitingTheTarget) {
  CameraDescription turned = sample_camera(), orbited = sample_camera();
  turn_camera(turned, 30, 10);
  orbit_camera(orbited, 30, 10);
  EXPECT_EQ(turned.position, sample_camera().position);
  EXPECT_EQ(orbited.target, sample_camera().target);
  EXPECT_NEAR(distance_of(turned), distance_of(sample_camera()), kRounding);
  EXPECT_NEAR(distance_of(orbited), distance_of(sample_camera()), kRounding);
  EXPECT_GT(window_of(turned, sample_camera().target).x, 320.0) << "a turn to the left moves the picture to the right";
  EXPECT_GT(window_of(turned, sample_camera().target).y, 240.0) << "a turn upwards moves the picture down";
  EXPECT_GT(orbited.position.y, sample_camera().position.y);
}

TEST(CameraControl, RotationsStopAtTheVertical) {
  CameraDescription turned = sample_camera(), orbited = sample_camera();
  for (int i = 0; i < 200; ++i) {
    turn_camera(turned, 0, 3);
    orbit_camera(orbited, 0, 3);
  }
  for (const CameraDescription& c : {turned, orbited}) {
    const glm::dvec3 ahead = glm::normalize(c.target - c.position);
    EXPECT_GT(std::fabs(ahead.y), 0.99);
    EXPECT_GT(glm::length(glm::cross(ahead, c.up)), 0.01) << "the view still has an upper side";
  }
  turn_camera(turned, 0, 170);
  EXPECT_GT((turned.target - turned.position).y, 0.0) << "a single large turn does not go beyond it either";
}

TEST(CameraControl, PanningMovesTheTargetWithTheMouse) {
  for (const Projection type : {Projection::perspective, Projection::orthographic}) {
    CameraDescription c = sample_camera();
    c.type = type;
    pan_camera(c, 48.0 / 480.0, -24.0 / 480.0);
    const glm::dvec2 at = window_of(c, sample_camera().target);
    EXPECT_NEAR(at.x, 320.0 + 48.0, 1e-9);
    EXPECT_NEAR(at.y, 240.0 - 24.0, 1e-9);
  }
}

TEST(CameraControl, ZoomingHalvesTheDistanceOrTheHeight) {
  CameraDescription c = sample_camera();
  zoom_camera(c, 2.0);
  EXPECT_NEAR(distance_of(c), 0.5 * distance_of(sample_camera()), kRounding);
  EXPECT_EQ(c.target, sample_camera().target);
  c.type = Projection::orthographic;
  zoom_camera(c, 2.0);
  EXPECT_EQ(c.height, 1.0);
}

TEST(CameraControl, EveryMovementChangesTheCameraAndItsOppositeRestoresIt) {
  const std::pair<Action, Action> pairs[] = {{Action::forward, Action::backward},
                                             {Action::left, Action::right},
                                             {Action::up, Action::down},
                                             {Action::turn_left, Action::turn_right},
                                             {Action::pitch_up, Action::pitch_down}};
  for (const auto& [there, back] : pairs) {
    CameraDescription c = sample_camera();
    apply_movement(c, there, 0.1);
    EXPECT_GT(glm::distance(c.position, sample_camera().position) + glm::distance(c.target, sample_camera().target), 0.01);
    apply_movement(c, back, 0.1);
    EXPECT_NEAR(glm::distance(c.position, sample_camera().position), 0.0, kRounding);
    EXPECT_NEAR(glm::distance(c.target, sample_camera().target), 0.0, kRounding);
  }
}

TEST(CameraControl, CloseToTheTargetTheSpeedHasAMinimum) {
  CameraDescription c = sample_camera();
  apply_movement(c, Action::left, 0.5, 0.5 * distance_of(c));
  EXPECT_NEAR(glm::distance(c.position, sample_camera().position), 0.3 * distance_of(sample_camera()), kRounding);
  c = sample_camera();
  zoom_camera(c, 1000.0);
  const glm::dvec3 near = c.position;
  apply_movement(c, Action::left, 0.5, 2.0);
  EXPECT_NEAR(glm::distance(c.position, near), 0.3 * 2.0, 1e-9) << "the distance is divided by a thousandth of its own";
}

TEST(CameraControl, TheDepthRangeOnlyGrows) {
  CameraDescription c = sample_camera();
  c.near = 4;
  c.far = 8;
  widen_depth_range(c);
  EXPECT_EQ(c.near, 0.0) << "cuts off nothing; see near_plane()";
  EXPECT_GT(c.far, 100.0);
  const CameraDescription wide = c;
  widen_depth_range(c);
  EXPECT_EQ(c.near, wide.near);
  EXPECT_EQ(c.far, wide.far);
  c.far = 0.0;
  widen_depth_range(c);
  EXPECT_EQ(c.far, 0.0) << "cuts off nothing; see far_plane()";
}

}  // namespace
}  // namespace halfspace
