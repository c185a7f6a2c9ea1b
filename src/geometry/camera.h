// SPDX-License-Identifier: Apache-2.0
//
// View and projection matrices: right-handed, y up, the camera looks along −z; clip = P·V·M·p.
//
// All are computed in double, without libm (the same bits on every machine). Multiply them in double and round the
// product to float once: glm::mat4(projection * view).
#pragma once

#include <glm/glm.hpp>

namespace halfspace {

/// World space to view space. eye and target must differ, and up must not be parallel to their difference.
glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

/// OpenGL's clip space: depth −w at the near plane, +w at the far plane. fovy (the full vertical angle, in radians,
/// in (0, π)), aspect = width / height > 0, 0 < near < far.
glm::dmat4 perspective_gl(double fovy, double aspect, double near, double far);

/// Reversed Z, clip depth in [0, w]: window depth 1 at the near plane, 0 at the far plane. far may be infinity.
/// For ClipDepth::zero_to_one with CompareOp::greater and depth cleared to 0.
glm::dmat4 perspective_reversed(double fovy, double aspect, double near, double far);

/// The box that is `height` high and height · aspect wide round the view axis; near and far are distances along −z,
/// near < far (near may be negative). Depth as above.
glm::dmat4 orthographic_gl(double height, double aspect, double near, double far);
glm::dmat4 orthographic_reversed(double height, double aspect, double near, double far);

/// The matrix that takes normals to world space where world_from_object takes positions: the inverse transpose of its upper 3x3 part,
/// computed in double and rounded once. It keeps normals perpendicular to surfaces under non-uniform scale; its results are not of unit
/// length. The upper 3x3 part must be invertible.
glm::mat3 normal_matrix(const glm::dmat4& world_from_object);

}  // namespace halfspace
