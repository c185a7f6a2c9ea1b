// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/core/units.h"
#include "halfspace/geometry/camera.h"

namespace halfspace::HS_LANES {

namespace {

// Returns the view of a camera that matrix_camera() has accepted.
View matrix_view(const CameraDescription& c, int width, int height) {
  const glm::dmat4 &world = c.matrices->world_from_camera, &p = c.matrices->clip_from_camera;
  const glm::dvec3 right(world[0]), up(world[1]), back(world[2]);
  const glm::dmat2 plane = glm::inverse(glm::dmat2(p[0][0], p[0][1], p[1][0], p[1][1]));
  View v{{}, c.position, glm::dvec3(0.0), -back, right, up, glm::length(plane[0]), glm::length(plane[1]), c.near, c.far, width, height};
  // Depth (w − z) / 2 is 1 at the near plane and 0 at the far plane.
  glm::dmat4 reversed = p;
  for (int i = 0; i < 4; ++i) reversed[i][2] = 0.5 * (p[i][3] - p[i][2]);
  glm::dmat4 camera_from_world(glm::transpose(glm::dmat3(world)));
  camera_from_world[3] = camera_from_world * glm::dvec4(-c.position, 1.0);
  v.clip_from_world = reversed * camera_from_world;
  if (c.type == Projection::orthographic) v.to_eye_ws = back;
  const glm::dvec2 center = plane * glm::dvec2(p[2][0] - p[3][0], p[2][1] - p[3][1]);
  v.ray_ws = v.forward_ws + right * center.x + up * center.y;
  v.ray_x_ws = right * plane[0].x + up * plane[0].y;
  v.ray_y_ws = right * plane[1].x + up * plane[1].y;
  v.symmetric = center == glm::dvec2(0.0) && p[1][0] == 0.0 && p[0][1] == 0.0;
  return v;
}

bool is_finite_matrix(const glm::dmat4& m) {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      if (!std::isfinite(m[i][j])) return false;
    }
  }
  return true;
}

bool is_rigid(const glm::dmat4& m) {
  constexpr double kTolerance = 1e-5;  // for matrices that were stored as floats
  const glm::dmat3 turn(m), product = glm::transpose(turn) * turn;
  for (int i = 0; i < 3; ++i) {
    if (m[i][3] != 0.0) return false;
    for (int j = 0; j < 3; ++j) {
      if (std::fabs(product[i][j] - (i == j ? 1.0 : 0.0)) > kTolerance) return false;
    }
  }
  return m[3][3] == 1.0 && glm::determinant(turn) > 0.0;
}

[[noreturn]] void reject_projection(const char* expected) {
  throw InputError(std::string("camera: the projection matrix cannot be used; expected ") + expected);
}

// Sets the planes of a projection, z_clip = a·z + b.
void set_planes(CameraDescription& c, double a, double b) {
  if (c.type == Projection::perspective) {
    c.near = b / (a - 1.0);
    c.far = a == -1.0 ? kFarthest : b / (a + 1.0);  // a is -1 for an infinite far plane
  } else {
    c.near = (b + 1.0) / a;
    c.far = (b - 1.0) / a;
  }
  if (!(c.near < c.far) || (c.type == Projection::perspective && !(c.near > 0.0)))
    reject_projection("a near plane in front of the far plane, and of the camera");
}

}  // namespace

CameraDescription matrix_camera(const CameraMatrices& matrices) {
  const FloatMode float_mode;
  const glm::dmat4 &world = matrices.world_from_camera, &p = matrices.clip_from_camera;
  if (!is_finite_matrix(world) || !is_finite_matrix(p)) throw InputError("camera: a matrix is not finite; expected finite numbers");
  if (!is_rigid(world)) throw InputError("camera: the pose is not a rotation and a translation; expected a rigid transform");
  CameraDescription c;
  const glm::dvec4 w(p[0][3], p[1][3], p[2][3], p[3][3]);
  if (w != glm::dvec4(0, 0, -1, 0) && w != glm::dvec4(0, 0, 0, 1)) reject_projection("(0, 0, -1, 0) or (0, 0, 0, 1) as the last row");
  c.type = w.z == 0.0 ? Projection::orthographic : Projection::perspective;
  if (p[0][2] != 0.0 || p[1][2] != 0.0) reject_projection("a depth that depends only on z");
  if (c.type == Projection::perspective ? p[3][0] != 0.0 || p[3][1] != 0.0 : p[2][0] != 0.0 || p[2][1] != 0.0)
    reject_projection("a perspective or orthographic projection");
  if (!(p[0][0] * p[1][1] - p[1][0] * p[0][1] > 0.0)) reject_projection("a projection that does not mirror the image");
  set_planes(c, p[2][2], p[3][2]);
  c.position = glm::dvec3(world[3]);
  c.target = c.position - glm::dvec3(world[2]);
  c.up = glm::dvec3(world[1]);
  c.height = 2.0 / p[1][1];
  c.matrices = matrices;
  return c;
}

double near_plane(const CameraDescription& c) {
  if (c.near != 0.0 || c.type == Projection::orthographic) return c.near;
  return c.far == 0.0 ? 0x1p-30 : 0x1p-40 * c.far;
}

double far_plane(const CameraDescription& c) {
  if (c.far != 0.0) return c.far;
  return c.type == Projection::perspective ? kFarthest : c.near + 1000.0;
}

View make_view(const CameraDescription& c, int width, int height) {
  const FloatMode float_mode;
  if (c.matrices) return matrix_view(c, width, height);
  const double near = near_plane(c), far = far_plane(c);
  const double aspect = static_cast<double>(width) / height;
  const glm::dmat4 view = look_at(c.position, c.target, c.up);
  const glm::dvec3 right(view[0][0], view[1][0], view[2][0]), up(view[0][1], view[1][1], view[2][1]),
      back(view[0][2], view[1][2], view[2][2]);
  const SinCosDouble half = sincos_radians(0.5 * c.fov * kRadiansPerDegree);
  View v{{}, c.position, glm::dvec3(0.0), -back, right, up, 0.0, half.sin / half.cos, near, far, width, height};
  if (c.type == Projection::perspective) {
    v.clip_from_world = perspective_reversed(c.fov * kRadiansPerDegree, aspect, near, far) * view;
  } else {
    v.clip_from_world = orthographic_reversed(c.height, aspect, near, far) * view;
    v.to_eye_ws = back;
  }
  v.tan_x = v.tan_y * aspect;
  v.ray_ws = v.forward_ws;
  v.ray_x_ws = right * v.tan_x;
  v.ray_y_ws = up * v.tan_y;
  return v;
}

double pixel_width(const View& view, const glm::dvec3& position_rws) {
  const glm::dmat4& m = view.clip_from_world;
  const double spanned = view.to_eye_ws == glm::dvec3(0.0) ? 2.0 * view.tan_y * glm::dot(position_rws, view.forward_ws)
                                                           : 2.0 / glm::length(glm::dvec3(m[0][1], m[1][1], m[2][1]));
  return spanned / view.height_px;
}

namespace {

double corner_tangent_squared(const View& v) { return v.tan_x * v.tan_x + v.tan_y * v.tan_y; }
double focal_px(const View& v) { return 0.5 * v.height_px / v.tan_y; }
bool is_orthographic(const View& v) { return v.to_eye_ws != glm::dvec3(0.0); }

glm::dvec4 row_of(const glm::dmat4& m, int i) { return {m[0][i], m[1][i], m[2][i], m[3][i]}; }

}  // namespace

double pixels_per_unit(const View& v, const glm::dvec3& center_ws, double radius) {
  if (is_orthographic(v)) return 1.0 / pixel_width(v, {});
  const double nearest = std::max(v.near, glm::dot(center_ws - v.eye_ws, v.forward_ws) - radius);
  // A unit move at a given depth moves the projected point by at most √(1 + tan²) / depth. This is reached in a corner of the
  // image.
  return focal_px(v) * std::sqrt(1.0 + corner_tangent_squared(v)) / nearest;
}

double silhouette_pixels_per_unit(const View& v, const glm::dvec3& center_ws, double radius) {
  if (is_orthographic(v)) return 1.0 / pixel_width(v, {});
  const glm::dvec3 from_eye = center_ws - v.eye_ws;
  const double distance_squared = glm::dot(from_eye, from_eye), depth = glm::dot(from_eye, v.forward_ws);
  if (distance_squared <= radius * radius) return pixels_per_unit(v, center_ws, radius);
  // The silhouette is at an angle α from the center with sin α = r/d. Reducing the radius by δ rotates it by δ/√(d² − r²).
  // Projection stretches angles by 1 + tan²θ, where θ is the angle from the view axis.
  const double tangent_length = std::sqrt(distance_squared - radius * radius);
  const double corner = std::sqrt(corner_tangent_squared(v));
  double farthest = corner;
  if (depth > 0.0) {
    const double center = std::sqrt(std::max(0.0, distance_squared - depth * depth)) / depth, own = radius / tangent_length;
    if (center * own < 1.0) farthest = std::min(corner, (center + own) / (1.0 - center * own));
  }
  return focal_px(v) * (1.0 + farthest * farthest) / tangent_length;
}

// The square root of the largest row sum of AᵀA, which is at least its largest eigenvalue.
double stretch_of(const glm::dmat4& m) {
  const glm::dmat3 a(m), squares = glm::transpose(a) * a;
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) largest = std::max(largest, std::fabs(squares[0][i]) + std::fabs(squares[1][i]) + std::fabs(squares[2][i]));
  return std::sqrt(largest);
}

double turned_pixels_per_unit(const View& v, const glm::dvec3& center_ws, double radius) {
  if (is_orthographic(v)) return pixels_per_unit(v, center_ws, radius);
  // A point at distance d in the image has a depth of at least d / √(1 + tan²).
  const double nearest = std::max(v.near, glm::distance(center_ws, v.eye_ws) - radius);
  return focal_px(v) * (1.0 + corner_tangent_squared(v)) / nearest;
}

bool is_outside(const View& v, const glm::dvec3& center_ws, double radius) {
  const glm::dvec4 w = row_of(v.clip_from_world, 3);
  for (const int axis : {0, 1}) {
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec4 plane = w + side * row_of(v.clip_from_world, axis);
      if (glm::dot(plane, glm::dvec4(center_ws, 1.0)) < -radius * glm::length(glm::dvec3(plane))) return true;
    }
  }
  return false;
}

namespace {

glm::dmat3 rotation_about(int axis, double degrees) {
  const double turns = degrees / 360.0;
  const SinCosDouble a = sincos_turns(turns - std::floor(turns));
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  glm::dmat3 m(1.0);
  m[i][i] = m[j][j] = a.cos;
  m[i][j] = a.sin;
  m[j][i] = -a.sin;
  return m;
}

}  // namespace

glm::dmat4 world_from_object(const Placement& p) {
  if (p.matrix) return *p.matrix;
  const glm::dmat3 turn = rotation_about(1, p.rotation.y) * rotation_about(0, p.rotation.x) * rotation_about(2, p.rotation.z);
  glm::dmat4 m(1.0);
  for (int k = 0; k < 3; ++k) m[k] = glm::dvec4(turn[k] * p.scale[k], 0.0);
  m[3] = glm::dvec4(p.position, 1.0);
  return m;
}

}  // namespace halfspace::HS_LANES
