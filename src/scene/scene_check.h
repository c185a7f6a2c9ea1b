// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "halfspace/scene/description.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Checks constraints that the types and ranges of keys do not express: names that must exist, values that must be consistent with
/// each other, and limits on memory. Throws InputError with a message that begins with `source`.
void check_scene(SceneDescription& scene, const std::string& source);

/// Returns the first of an object's keys that needs a mesh and so cannot be used with Shape::sphere: maps, reflection, per-vertex
/// or per-triangle lighting, two-sided surfaces, non-uniform scale. Returns an empty string if there is none.
std::string_view mesh_only_key(const ObjectDescription& o);

/// Returns why a key of the object has no effect, and what is expected instead, or an empty string if it can have one. Surface keys have no
/// effect on a model that keeps its own materials, and height maps have none on any model.
std::string lack_of_effect(const ObjectDescription& o, std::string_view key);

/// Returns true if all ancestors of an object are scaled uniformly, so that a sphere remains a sphere. check_scene() must have accepted the
/// scene.
bool has_uniformly_scaled_ancestors(const SceneDescription& scene, const ObjectDescription& o);

/// Checks that all objects together stay within the limits on vertices and copies. Throws InputError like check_scene.
void check_mesh_limits(const Named<ObjectDescription>& objects, const std::string& source);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
