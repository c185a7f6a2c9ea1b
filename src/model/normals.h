// SPDX-License-Identifier: Apache-2.0
//
// Normals for meshes that have none.
#pragma once

#include <span>

#include "halfspace/model/model.h"

namespace halfspace {

/// Returns the vector scaled to unit length, rounded to float. A vector that has this length up to the rounding of floats is returned
/// unchanged, so that a file that was written from unit normals gives the same normals. n must be finite and not 0.
glm::vec3 unit_vector(const glm::dvec3& n);

/// Gives every triangle three vertices of its own with the normal of its plane. A degenerate triangle gets the normal (0, 1, 0).
/// Requires MeshTopology::triangles. All other vertex data is copied; tangents are removed.
void add_flat_normals(ModelMesh& mesh);

/// Gives the mesh smooth normals: the mean of the unit normals of the triangles around a vertex, weighted by their angles there (Thürmer
/// and Wüthrich, "Computing vertex normals from polygonal facets", 1998). Two triangles that meet in an edge share a normal if the angle
/// between their planes is at most `crease_degrees` and, if `groups` is not empty, if they are in the same group (one number per triangle;
/// group 0 is never smooth; with groups the angle is ignored). Vertices with equal positions are joined; vertices at creases are split.
void add_smooth_normals(ModelMesh& mesh, float crease_degrees, std::span<const uint32_t> groups = {});

}  // namespace halfspace
