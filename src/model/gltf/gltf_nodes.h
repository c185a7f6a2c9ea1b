// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/model/gltf/gltf_accessors.h"
#include "halfspace/model/gltf/gltf_document.h"
#include "halfspace/model/gltf/gltf_meshes.h"
#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Reads the nodes and scenes of a glTF file, including EXT_mesh_gpu_instancing. Meshes, skins, cameras and lights must have been read.
/// Throws InputError if the nodes are not a forest, or if their transforms overflow.
void read_gltf_nodes(GltfAccessors& accessors, const std::vector<GltfMesh>& meshes, Model& model);

/// Reads the skins of a glTF file.
void read_gltf_skins(GltfAccessors& accessors, Model& model);

/// Reads the cameras of a glTF file and the lights of KHR_lights_punctual.
void read_gltf_cameras_and_lights(GltfDocument& document, Model& model);

}  // namespace halfspace::HS_LANES
