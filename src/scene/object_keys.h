// SPDX-License-Identifier: Apache-2.0
//
// Which keys of an object have an effect, and which need a mesh.
#pragma once

#include <string>
#include <string_view>

#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// Returns the first of an object's keys that needs a mesh and so cannot be used with Shape::sphere: maps, reflection, per-vertex
/// or per-triangle lighting, two-sided surfaces, lines of normals, non-uniform scale. Returns an empty string if there is none.
std::string_view mesh_only_key(const ObjectDescription& o);

/// Returns true if the object is a model that is drawn with the materials of its file.
bool has_own_materials(const ObjectDescription& o);

/// Returns why a key of the object has no effect, and what is expected instead, or an empty string if it can have one. Of the surface keys,
/// only `textured`, `normal` and `shading` have an effect on a model that keeps its own materials. Height maps have none on any model.
std::string lack_of_effect(const ObjectDescription& o, std::string_view key);

/// Returns true if the object can be lit at this rate. Materials of model files are lit per pixel or not at all.
bool offers_shading(const ObjectDescription& o, ShadingRate rate);

/// Returns true if all ancestors of an object are scaled uniformly, so that a sphere remains a sphere. check_scene() must have accepted the
/// scene.
bool has_uniformly_scaled_ancestors(const SceneDescription& scene, const ObjectDescription& o);

/// Returns true if a placement scales all axes by the same factor, up to the sign.
bool is_uniformly_scaled(const Placement& p);

}  // namespace halfspace::HS_LANES
