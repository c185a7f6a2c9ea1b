// SPDX-License-Identifier: Apache-2.0
#include "scene/view.h"

#include <cmath>
#include <numbers>

#include "core/trig_double.h"
#include "scene/camera.h"

namespace halfspace {

namespace {
constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
}  // namespace

View make_view(const CameraDescription& c, int width, int height) {
  const double aspect = static_cast<double>(width) / height;
  const glm::dmat4 view = look_at(c.position, c.target, c.up);
  const glm::dvec3 right(view[0][0], view[1][0], view[2][0]), up(view[0][1], view[1][1], view[2][1]),
      back(view[0][2], view[1][2], view[2][2]);
  const SinCosDouble half = sincos_radians(0.5 * c.fov * kRadiansPerDegree);
  View v{{}, c.position, glm::dvec3(0.0), -back, right, up, 0.0, half.sin / half.cos, c.near, width, height};
  if (c.type == Projection::perspective) {
    v.clip_from_world = perspective_reversed(c.fov * kRadiansPerDegree, aspect, c.near, c.far) * view;
  } else {
    v.clip_from_world = orthographic_reversed(c.height, aspect, c.near, c.far) * view;
    v.to_eye_ws = back;
  }
  v.tan_x = v.tan_y * aspect;
  return v;
}

double pixel_width(const View& view, const glm::dvec3& position_ew) {
  const glm::dmat4& m = view.clip_from_world;
  const double spanned = view.to_eye_ws == glm::dvec3(0.0) ? 2.0 * view.tan_y * glm::dot(position_ew, view.forward_ws)
                                                           : 2.0 / glm::length(glm::dvec3(m[0][1], m[1][1], m[2][1]));
  return spanned / view.height_px;
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
  const glm::dmat3 turn = rotation_about(1, p.rotation.y) * rotation_about(0, p.rotation.x) * rotation_about(2, p.rotation.z);
  glm::dmat4 m(1.0);
  for (int k = 0; k < 3; ++k) m[k] = glm::dvec4(turn[k] * p.scale[k], 0.0);
  m[3] = glm::dvec4(p.position, 1.0);
  return m;
}

}  // namespace halfspace
