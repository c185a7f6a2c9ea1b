// SPDX-License-Identifier: Apache-2.0
//
// View and projection matrices. View space is right-handed with y up; the camera looks along −z. clip = P·V·M·p.
//
// All matrices are computed in double without libm, so they are bit-identical on every machine. Multiply them in double and
// convert the product to float once: glm::mat4(projection * view).
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// World space to view space. eye and target must differ, and up must not be parallel to their difference.
glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

/// Perspective projection with OpenGL's clip depth: −w at the near plane, +w at the far plane. fovy is the full vertical angle in
/// radians, in (0, π). aspect = width / height > 0, 0 < near < far.
glm::dmat4 perspective_gl(double fovy, double aspect, double near, double far);

/// Perspective projection with reversed Z and clip depth in [0, w]: window depth is 1 at the near plane and 0 at the far plane. far
/// may be infinity. Use it with ClipDepth::zero_to_one, CompareOp::greater and depth cleared to 0.
glm::dmat4 perspective_reversed(double fovy, double aspect, double near, double far);

/// Orthographic projections of a box centered on the view axis, `height` high and height · aspect wide. near and far are distances
/// along −z; near < far, and near may be negative. The depth ranges match perspective_gl and perspective_reversed.
glm::dmat4 orthographic_gl(double height, double aspect, double near, double far);
glm::dmat4 orthographic_reversed(double height, double aspect, double near, double far);

/// Returns the inverse transpose of the upper 3x3 part of world_from_object, computed in double and rounded once. It transforms
/// normals to world space and keeps them perpendicular to surfaces under non-uniform scale. Transformed normals do not have unit
/// length. The upper 3x3 part must be invertible.
glm::mat3 normal_matrix(const glm::dmat4& world_from_object);

}  // namespace halfspace::HS_LANES
