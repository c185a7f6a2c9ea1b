// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "halfspace/scene/description.h"

namespace halfspace {

/// What no key can tell alone: names that must exist, values that must fit each other, sizes that must be bearable. Throws
/// InputError that begins with `source`.
void check_scene(SceneDescription& scene, const std::string& source);

/// The first of an object's keys that asks for a mesh, so that Shape::sphere cannot show it: maps, reflection, light by vertex or triangle,
/// a back face, a scale that is not the same every way. Empty where none does.
std::string_view key_for_meshes(const ObjectDescription& o);

/// That all objects together ask for no more memory than is bearable. Throws as above.
void check_room(const Named<ObjectDescription>& objects, const std::string& source);

}  // namespace halfspace
