// SPDX-License-Identifier: Apache-2.0
//
// Morph targets and skins.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Adds the morph targets of a mesh, scaled by their weights. Missing weights are 0. Targets without normals leave normals unchanged.
void apply_morph_targets(ModelMesh& mesh, std::span<const float> weights);

/// Transforms each vertex by the average of the matrices of its joints, weighted by ModelMesh::weights. There must be one affine matrix per
/// joint of the skin. Normals are transformed by the inverse transpose. The origin of the mesh is added to the positions.
void apply_skin(ModelMesh& mesh, std::span<const glm::dmat4> joint_matrices);

}  // namespace halfspace::HS_LANES
