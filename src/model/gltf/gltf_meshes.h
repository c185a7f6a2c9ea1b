// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/model/gltf/gltf_accessors.h"
#include "halfspace/model/gltf/gltf_document.h"
#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// A mesh of a glTF file, which has one ModelMesh per primitive.
struct GltfMesh {
  std::vector<int> parts;             ///< indices in Model::meshes
  std::size_t targets = 0;            ///< number of morph targets
  std::vector<float> weights;         ///< default weights of the targets; empty: 0
  std::size_t deformed_vertices = 0;  ///< number of vertices of parts with morph targets or joints
};

/// Reads all meshes and adds their primitives to the model. Materials and variants must have been read before.
std::vector<GltfMesh> gltf_meshes(GltfAccessors& accessors, Model& model);

}  // namespace halfspace::HS_LANES
