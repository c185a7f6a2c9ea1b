// SPDX-License-Identifier: Apache-2.0
//
// Turns the lists of an OBJ file into indexed meshes.
#pragma once

#include <vector>

#include "halfspace/model/model.h"
#include "halfspace/model/obj_text.h"

namespace halfspace {

struct ObjMeshes {
  std::vector<ModelMesh> meshes;  ///< `material` is that of the states
  double diagonal = 0.0;          ///< of the bounds of all vertices that are used, in model units
};

/// Makes one mesh for each combination of material, topology and presence of normals; a mesh has the name of its first object or group.
/// Corners with equal indices share a vertex. All meshes have the center of the bounds as their origin, so that equal positions of two
/// meshes stay equal. Colors are taken as sRGB-encoded, from 0 to 255 if any is greater than 1. Triangles without normals get smooth
/// ones: within smoothing groups if the file has any, else across edges of at most crease_degrees, within one mesh.
ObjMeshes obj_meshes(const ObjText& obj, float crease_degrees);

}  // namespace halfspace
