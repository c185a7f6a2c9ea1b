// SPDX-License-Identifier: Apache-2.0
//
// Materials of the scene that replace materials of a model file.
#pragma once

#include <string>
#include <string_view>

#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// Returns an error about a name that no material of the scene has: "no material 'red'; expected ...".
std::string no_material(const SceneDescription& scene, std::string_view name);

/// Returns the material of the scene that replaces the material `name` of the object's model file: the entry of `model_materials` for that
/// name, or else the object's `material`. Returns null if the model keeps its own. The object must have passed check_material_overrides.
const SurfaceDescription* override_of(const SceneDescription& scene, const ObjectDescription& o, std::string_view name);

/// Throws InputError with a message that begins with `where` if `model_materials` is not of the form "NAME=MATERIAL, NAME=MATERIAL", or
/// names a material that the scene does not have.
void check_material_overrides(const SceneDescription& scene, const ObjectDescription& o, const std::string& where);

}  // namespace halfspace::HS_LANES
