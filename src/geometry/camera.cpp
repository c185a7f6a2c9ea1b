// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/core/vec.h"

namespace halfspace::HS_LANES {

namespace {

glm::dvec3 checked_unit(const glm::dvec3& v) {
  const glm::dvec3 u = unit_or_zero(v);
  const double length = glm::dot(u, u);
  HS_CHECK_OP(length, >, 0.0,
              "look_at: the eye is the target, or up is parallel to the line between them; expected two points and another direction");
  return u;
}

// A perspective projection with clip w = −z and clip depth a·z + b. x and y are scaled so that the angle fovy spans [−w, w].
glm::dmat4 perspective(double fovy, double aspect, double a, double b) {
  HS_CHECK_OP(fovy, >, 0.0, "perspective: the angle of view is not positive; expected radians between 0 and pi");
  HS_CHECK_OP(fovy, <, std::numbers::pi, "perspective: the angle of view is too large; expected radians between 0 and pi");
  HS_CHECK_OP(aspect, >, 0.0, "projection: the aspect ratio is not positive; expected width / height");
  const SinCosDouble half = sincos_radians(0.5 * fovy);
  glm::dmat4 m(0.0);
  m[0][0] = half.cos / (half.sin * aspect);
  m[1][1] = half.cos / half.sin;
  m[2][2] = a;
  m[2][3] = -1.0;
  m[3][2] = b;
  return m;
}

glm::dmat4 orthographic(double height, double aspect, double a, double b) {
  HS_CHECK_OP(height, >, 0.0, "orthographic: the height is not positive; expected more than 0");
  HS_CHECK_OP(aspect, >, 0.0, "projection: the aspect ratio is not positive; expected width / height");
  glm::dmat4 m(1.0);
  m[0][0] = 2.0 / (height * aspect);
  m[1][1] = 2.0 / height;
  m[2][2] = a;
  m[3][2] = b;
  return m;
}

}  // namespace

glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
  const FloatMode float_mode;
  const glm::dvec3 back = checked_unit(eye - target);
  const glm::dvec3 right = checked_unit(glm::cross(up, back));
  const glm::dvec3 true_up = glm::cross(back, right);
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) {
    m[i][0] = right[i];
    m[i][1] = true_up[i];
    m[i][2] = back[i];
  }
  m[3] = glm::dvec4(-glm::dot(right, eye), -glm::dot(true_up, eye), -glm::dot(back, eye), 1.0);
  return m;
}

// Clip depth a·z + b must equal −w at z = −near and w at z = −far, where w = −z.
glm::dmat4 perspective_gl(double fovy, double aspect, double near, double far) {
  const FloatMode float_mode;
  HS_CHECK_OP(near, >, 0.0, "perspective: the near plane is not in front of the eye; expected more than 0");
  HS_CHECK_OP(near, <, far, "projection: the far plane is not behind the near plane; expected near < far");
  HS_CHECK_OP(far, <, std::numeric_limits<double>::infinity(),
              "perspective_gl: the far plane is infinitely far; expected a finite distance, or perspective_reversed");
  return perspective(fovy, aspect, -(far + near) / (far - near), -2.0 * far * near / (far - near));
}

// Clip depth must equal w at z = −near and 0 at z = −far. The limit for an infinite far plane is a = 0, b = near.
glm::dmat4 perspective_reversed(double fovy, double aspect, double near, double far) {
  const FloatMode float_mode;
  HS_CHECK_OP(near, >, 0.0, "perspective: the near plane is not in front of the eye; expected more than 0");
  HS_CHECK_OP(near, <, far, "projection: the far plane is not behind the near plane; expected near < far");
  if (std::isinf(far)) return perspective(fovy, aspect, 0.0, near);
  return perspective(fovy, aspect, near / (far - near), far * near / (far - near));
}

glm::dmat4 orthographic_gl(double height, double aspect, double near, double far) {
  const FloatMode float_mode;
  HS_CHECK_OP(near, <, far, "projection: the far plane is not behind the near plane; expected near < far");
  return orthographic(height, aspect, -2.0 / (far - near), -(far + near) / (far - near));
}

glm::dmat4 orthographic_reversed(double height, double aspect, double near, double far) {
  const FloatMode float_mode;
  HS_CHECK_OP(near, <, far, "projection: the far plane is not behind the near plane; expected near < far");
  return orthographic(height, aspect, 1.0 / (far - near), far / (far - near));
}

glm::mat3 normal_matrix(const glm::dmat4& world_from_object) {
  const FloatMode float_mode;
  return glm::mat3(glm::transpose(glm::inverse(glm::dmat3(world_from_object))));
}

}  // namespace halfspace::HS_LANES
