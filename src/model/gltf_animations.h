// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/model/gltf_accessors.h"
#include "halfspace/model/model.h"

namespace halfspace {

/// Reads the animations of a glTF file. The model must have its nodes and meshes. Channels that cannot be applied are left out with a
/// warning.
void read_gltf_animations(GltfAccessors& accessors, Model& model);

}  // namespace halfspace
