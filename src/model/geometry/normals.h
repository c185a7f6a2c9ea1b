// SPDX-License-Identifier: Apache-2.0
//
// Computes normals for meshes without normals.
#pragma once

#include <span>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Returns the vector normalized and rounded to float. A vector that already has unit length except for float rounding is returned
/// unchanged, so that normals survive writing and reading a file. n must be finite and not 0.
glm::vec3 unit_vector(const glm::dvec3& n);

/// Gives every triangle its own three vertices with the normal of its plane. Degenerate triangles get the normal (0, 1, 0). Requires
/// MeshTopology::triangles. All other vertex data is copied; tangents are removed.
void add_flat_normals(ModelMesh& mesh);

/// Computes smooth normals: the average of the unit normals of the triangles around a vertex, weighted by their angles at the vertex
/// (Thürmer and Wüthrich, "Computing vertex normals from polygonal facets", 1998). Without `groups`, two triangles with a common edge share
/// a normal if the angle between their planes is at most `crease_degrees`. Otherwise, `groups` contains one smoothing group per triangle;
/// triangles share a normal if they are in the same group, except group 0, which is never smooth. Vertices with equal positions are joined;
/// vertices at creases are split.
void add_smooth_normals(ModelMesh& mesh, float crease_degrees, std::span<const uint32_t> groups = {});

/// Replaces normals that are 0 by the normals of the triangles around their vertices, weighted by area, or by (0, 1, 0) if the triangles
/// have no area. Returns their number.
std::size_t replace_missing_normals(ModelMesh& mesh);

}  // namespace halfspace::HS_LANES
