// SPDX-License-Identifier: Apache-2.0
//
// Tangents for normal maps.
#pragma once

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Computes the tangents of a mesh for the texture coordinates of set `uv_set`. The mesh must have that set and normals. The method is that
/// of MikkTSpace (M. Mikkelsen, "Simulation of wrinkled surfaces revisited", 2008), which glTF prescribes and most baking tools use: the
/// tangents of the triangles around a vertex that share position, normal, texture coordinate and orientation are averaged, weighted by
/// their angles, in the plane of the normal. Vertices at which tangents differ are split. Where texture coordinates are degenerate, a
/// tangent perpendicular to the normal is chosen.
void add_tangents(ModelMesh& mesh, int uv_set);

}  // namespace halfspace::HS_LANES
