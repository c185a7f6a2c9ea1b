// SPDX-License-Identifier: Apache-2.0
//
// Interpolation of animation channels (glTF 2.0, appendix C).
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Returns the spherical linear interpolation (slerp) from a to b along the shorter arc. a and b must have unit length, and t must be in
/// [0, 1]. The arc is halved until linear interpolation is exact to double precision. The result is bit-identical on every machine, and its
/// error is below 2e-15.
glm::dquat shortest_rotation(const glm::dquat& a, const glm::dquat& b, double t);

/// Returns the value of a channel at a time in seconds: `channel.width` numbers. Times outside the range of the keyframes are clamped to
/// it. Rotations have unit length.
std::vector<double> value_at(const AnimationChannel& channel, double time);

/// Applies all channels of an animation to the nodes of a model.
void apply_animation(const ModelAnimation& animation, double time, std::span<ModelNode> nodes);

}  // namespace halfspace::HS_LANES
