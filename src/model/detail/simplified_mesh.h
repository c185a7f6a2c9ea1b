// SPDX-License-Identifier: Apache-2.0
//
// Simplifies triangle meshes, with a bound on the geometric error.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/core/parallel.h"
#include "halfspace/model/detail/surface_distance.h"

namespace halfspace::HS_LANES {

/// A mesh to simplify.
struct OriginalMesh {
  /// mesh: at least one triangle. Not kept alive.
  explicit OriginalMesh(const TriangleList& mesh) : triangles(mesh), tree(mesh.positions, mesh.indices) {}

  TriangleList triangles;
  TriangleTree tree;
};

/// Triangles between vertices of the original mesh.
struct SimplifiedMesh {
  std::vector<uint32_t> indices;
  /// Every point of the original surface is at most this far from the simplified one, and vice versa. In the units of the positions.
  double error = 0.0;
};

/// The coarsest step of simplified(), and the finest.
inline constexpr int kCoarsestDetail = 1, kFinestDetail = 16;

/// Returns the error that a step aims at. size: the longest side of the bounding box of the mesh.
inline double detail_tolerance(double size, int step) { return size / static_cast<double>(1 << step); }

/// Removes vertices while the estimated error is at most half of detail_tolerance(), then computes the error. The result depends only on
/// the mesh, the step and the version of meshoptimizer.
///
/// Vertices on borders stay, so that meshes which share a border still meet. Where several vertices have the same position, as on seams of
/// texture coordinates and on sharp edges, both sides change in the same way. A mesh without gaps therefore has none afterwards.
SimplifiedMesh simplified(const OriginalMesh& mesh, int step, const Workers& workers);

/// Returns a text that changes with the results of simplified().
std::string detail_version();

}  // namespace halfspace::HS_LANES
