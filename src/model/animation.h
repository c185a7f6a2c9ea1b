// SPDX-License-Identifier: Apache-2.0
//
// Values of animation channels between their keys (glTF 2.0, appendix C).
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "halfspace/model/model.h"

namespace halfspace {

/// Returns the rotation at the fraction t of the way from a to b, at constant speed along the shorter way (slerp). a and b must have unit
/// length, and t must be in [0, 1]. The result is computed by halving the way until linear interpolation is exact to double precision, so
/// that it has the same bits on every machine; its error is below 2e-15.
glm::dquat shortest_rotation(const glm::dquat& a, const glm::dquat& b, double t);

/// Returns the value of a channel at a time in seconds: `channel.width` numbers. Times before the first and after the last key give the
/// value of that key. Rotations have unit length.
std::vector<double> value_at(const AnimationChannel& channel, double time);

/// Applies all channels of an animation to the nodes of a model.
void apply_animation(const ModelAnimation& animation, double time, std::span<ModelNode> nodes);

}  // namespace halfspace
