// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/model/gltf/gltf_accessors.h"
#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Reads the animations of a glTF file. Nodes and meshes must have been read. Channels that cannot be applied are skipped with a warning.
void read_gltf_animations(GltfAccessors& accessors, Model& model);

}  // namespace halfspace::HS_LANES
