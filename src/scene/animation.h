// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// Checks that the animation's target exists and matches its values. Throws InputError.
void check_animation(SceneDescription& scene, const AnimationDescription& animation, const std::string& path, const std::string& source);

/// Sets the animation's target to its value at a time in seconds. Throws InputError if the value is outside the key's range.
///   rate      value + rate · t
///   orbit     center + a·cos φ + b·sin φ, φ = 2π(t / period + phase)
///   wave      mean + swing·cos φ, clamped to the key's range
///   keyframes interpolated between the rows before and after t: linear, smooth (3x² − 2x³), or the row before (step).
///             Before the first row, its value; after the last row, starts over (loop) or keeps the last value.
void animate(SceneDescription& scene, const AnimationDescription& animation, const std::string& path, const std::string& source,
             double seconds);

}  // namespace halfspace::HS_LANES
