// SPDX-License-Identifier: Apache-2.0
//
// Transforms of nodes as matrices.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "halfspace/model/model.h"

namespace halfspace {

/// Returns the rotation scaled to unit length; the identity if its length is 0.
glm::dquat unit_rotation(const glm::dquat& rotation);

glm::dmat4 matrix_of(const NodeTransform& transform);
/// Returns the matrix of a node relative to its parent.
glm::dmat4 matrix_of(const ModelNode& node);

/// Returns whether all numbers of a matrix are at most 1e18, which also means finite.
bool is_bounded_transform(const glm::dmat4& matrix);

}  // namespace halfspace
