// SPDX-License-Identifier: Apache-2.0
//
// Vertex attributes and morph targets of glTF primitives.
#pragma once

#include "halfspace/model/gltf/gltf_accessors.h"
#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Reads the attributes of a primitive for all vertices, or for a subset. Positions may be infinite or NaN, and normals that have no
/// direction are 0. Values that are not finite in other attributes are replaced, with a warning. Normals and tangents are normalized.
/// Tangents without normals are skipped, and so are attributes that a mesh does not have. uv_sets: the indices of the sets of texture
/// coordinates to read, or -1.
void read_vertices(GltfAccessors& accessors, const GltfValue& primitive, std::size_t count, GltfSubset subset,
                   const std::array<int, 2>& uv_sets, ModelMesh& mesh);

}  // namespace halfspace::HS_LANES
