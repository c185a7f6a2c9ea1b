// SPDX-License-Identifier: Apache-2.0
#include "view/camera_control.h"

#include <algorithm>
#include <cmath>

#include "halfspace/core/trig_double.h"
#include "halfspace/core/units.h"

namespace halfspace {

namespace {

struct CameraAxes {
  glm::dvec3 right, up, forward;  // unit vectors, world space
  double distance;                // to the target
};

CameraAxes axes_of(const CameraDescription& c) {
  const glm::dvec3 ahead = c.target - c.position;
  const double distance = glm::length(ahead);
  const glm::dvec3 forward = ahead / distance;
  const glm::dvec3 right = glm::normalize(glm::cross(forward, c.up));
  return {right, glm::cross(right, forward), forward, distance};
}

// Rotates v around a unit axis, counter-clockwise as seen from its tip.
glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double degrees) {
  const SinCosDouble a = sincos_turns(degrees / 360.0);
  return v * a.cos + glm::cross(axis, v) * a.sin + axis * (glm::dot(axis, v) * (1.0 - a.cos));
}

// Rotates a view direction around `up` and then upwards, unless it would come within a degree of `up` or its opposite.
glm::dvec3 turned(const CameraDescription& c, const glm::dvec3& direction, double yaw_degrees, double pitch_degrees) {
  constexpr double kCosineOfOneDegree = 0.99984769515639;
  const glm::dvec3 up = glm::normalize(c.up);
  const glm::dvec3 level = rotated(direction, up, yaw_degrees);
  const glm::dvec3 pitched = rotated(level, glm::normalize(glm::cross(level, up)), pitch_degrees);
  const double length = glm::length(level);
  const bool beyond =
      std::fabs(glm::dot(pitched, up)) > kCosineOfOneDegree * length || glm::dot(glm::cross(pitched, up), glm::cross(level, up)) <= 0.0;
  return beyond ? level : pitched;
}

}  // namespace

void move_camera(CameraDescription& camera, const glm::dvec3& distance) {
  const CameraAxes a = axes_of(camera);
  const glm::dvec3 step = (a.right * distance.x + a.up * distance.y + a.forward * distance.z) * a.distance;
  camera.position += step;
  camera.target += step;
}

void turn_camera(CameraDescription& camera, double yaw_degrees, double pitch_degrees) {
  camera.target = camera.position + turned(camera, camera.target - camera.position, yaw_degrees, pitch_degrees);
}

void orbit_camera(CameraDescription& camera, double yaw_degrees, double pitch_degrees) {
  camera.position = camera.target - turned(camera, camera.target - camera.position, yaw_degrees, -pitch_degrees);
}

void pan_camera(CameraDescription& camera, double right, double down) {
  const SinCosDouble half = sincos_radians(0.5 * camera.fov * kRadiansPerDegree);
  const CameraAxes a = axes_of(camera);
  const double height = camera.type == Projection::perspective ? 2.0 * half.sin / half.cos : camera.height / a.distance;
  move_camera(camera, {-right * height, down * height, 0.0});
}

void zoom_camera(CameraDescription& camera, double factor) {
  if (camera.type == Projection::orthographic) {
    camera.height /= factor;
  } else {
    camera.position = camera.target - (camera.target - camera.position) / factor;
  }
}

void apply_movement(CameraDescription& camera, Action movement, double seconds, double nearest) {
  constexpr double kSpeed = 0.6;   // per second, in units of the distance to the target
  constexpr double kTurning = 45;  // degrees per second
  const double distance = glm::distance(camera.position, camera.target);
  const double step = kSpeed * seconds * std::max(1.0, nearest / distance), angle = kTurning * seconds;
  switch (movement) {
    case Action::forward: return move_camera(camera, {0, 0, step});
    case Action::backward: return move_camera(camera, {0, 0, -step});
    case Action::left: return move_camera(camera, {-step, 0, 0});
    case Action::right: return move_camera(camera, {step, 0, 0});
    case Action::up: return move_camera(camera, {0, step, 0});
    case Action::down: return move_camera(camera, {0, -step, 0});
    case Action::turn_left: return turn_camera(camera, angle, 0);
    case Action::turn_right: return turn_camera(camera, -angle, 0);
    case Action::pitch_up: return turn_camera(camera, 0, angle);
    case Action::pitch_down: return turn_camera(camera, 0, -angle);
    default: return;
  }
}

void widen_depth_range(CameraDescription& camera) {
  const double distance = glm::distance(camera.position, camera.target);
  camera.near = 0.0;
  if (camera.far != 0.0) camera.far = std::max(camera.far, 30.0 * distance);
}

}  // namespace halfspace
