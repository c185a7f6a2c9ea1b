// SPDX-License-Identifier: Apache-2.0
//
// Converts the lists of an OBJ file to indexed meshes.
#pragma once

#include <vector>

#include "halfspace/model/model.h"
#include "halfspace/model/obj/obj_text.h"

namespace halfspace::HS_LANES {

struct ObjMeshes {
  std::vector<ModelMesh> meshes;  ///< `material` is ObjState::material
  double diagonal = 0.0;          ///< length of the diagonal of the bounds of all used vertices, in model units
};

/// Creates one mesh for each combination of material, topology and presence of normals. A mesh has the name of its first object or group.
/// Corners with equal indices share a vertex. All meshes have the center of the bounds as their origin, so that equal positions of
/// different meshes stay equal. Colors in the file are sRGB-encoded, with a range of 0 to 255 if any color exceeds 1. Smooth normals are
/// computed for triangles without normals: within smoothing groups if the file has any, otherwise across edges with an angle of at most
/// crease_degrees.
ObjMeshes obj_meshes(const ObjText& obj, float crease_degrees);

}  // namespace halfspace::HS_LANES
