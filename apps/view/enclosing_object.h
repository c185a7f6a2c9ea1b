// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "halfspace/scene/description.h"

namespace halfspace {

/// Returns the name of the first visible sphere or cube that contains the point, or an empty string if there is none. Displacement is
/// ignored.
std::string enclosing_object(const SceneDescription& scene, const glm::dvec3& point);

}  // namespace halfspace
