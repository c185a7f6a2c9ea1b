// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// Checks constraints that the types and ranges of keys do not express: names that must exist, values that must be consistent with
/// each other, and limits on memory. Throws InputError with a message that begins with `source`.
void check_scene(SceneDescription& scene, const std::string& source);

/// Checks that all objects together stay within the limits on vertices and copies. Throws InputError like check_scene.
void check_mesh_limits(const Named<ObjectDescription>& objects, const std::string& source);

}  // namespace halfspace::HS_LANES
