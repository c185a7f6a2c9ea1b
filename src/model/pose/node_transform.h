// SPDX-License-Identifier: Apache-2.0
//
// Converts node transforms to matrices.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Returns the rotation normalized, or the identity if its length is 0.
glm::dquat unit_rotation(const glm::dquat& rotation);

glm::dmat4 matrix_of(const NodeTransform& transform);
/// Returns the matrix of a node relative to its parent.
glm::dmat4 matrix_of(const ModelNode& node);

/// Returns true if no element of a matrix exceeds 1e18 in magnitude or is NaN.
bool is_bounded_transform(const glm::dmat4& matrix);

}  // namespace halfspace::HS_LANES
