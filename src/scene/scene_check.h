// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/description.h"

namespace halfspace {

/// What no key can tell alone: names that must exist, values that must fit each other, sizes that must be bearable. Throws
/// InputError that begins with `source`.
void check_scene(SceneDescription& scene, const std::string& source);

/// That all objects together ask for no more memory than is bearable. Throws as above.
void check_room(const Named<ObjectDescription>& objects, const std::string& source);

}  // namespace halfspace
