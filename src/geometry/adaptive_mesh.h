// SPDX-License-Identifier: Apache-2.0
//
// Meshes of a surface that are fine only where a view needs it.
//
// A triangle of the mesh stands for the part of the surface over the same triangle of the unit square. Its error is the largest distance
// between a point of that part and the point of the triangle with the same (u, v). No point of the surface is farther from the mesh than
// the error, no point of the mesh farther from the surface, and textures are displaced by no more.
//
// Errors are measured once per patch, at the vertices of a regular grid (PatchErrors). A view then decides which triangles are bisected
// (patch_grid.h), and the mesh is made of what remains. Since a bisected triangle brings those parts of its neighbors with it that keep the
// mesh free of cracks, some triangles are finer than the view needs.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "halfspace/core/parallel.h"
#include "halfspace/geometry/mesh.h"
#include "halfspace/geometry/parametric_surface.h"
#include "halfspace/geometry/patch_grid.h"

namespace halfspace::HS_LANES {

/// The vertices of a patch and the errors of its triangles.
class PatchErrors {
 public:
  /// level: the patch has n = 2^level cells per side, 2 ≤ level ≤ 10.
  PatchErrors(const ParametricSurface& surface, const PatchGrid& grid, int patch, int level);

  int level() const { return level_; }
  int cells() const { return 1 << level_; }
  const glm::vec3& position(GridVertex v) const { return positions_[index(v)]; }
  /// Returns the larger error of the two triangles that the vertex bisects, of which those of other patches do not count. At least the
  /// error of every part of these triangles, as far as the grid shows it.
  float error(GridVertex v) const { return errors_[index(v)]; }
  /// Returns the largest error of the triangles with two cells. Triangles with one cell or half a cell have a smaller one if the grid
  /// resolves the surface.
  float finest_error() const { return finest_error_; }
  /// A ball around the patch: around its mean vertex.
  glm::dvec3 center() const { return center_; }
  double radius() const { return radius_; }

 private:
  std::size_t index(GridVertex v) const { return static_cast<std::size_t>(v.j * (cells() + 1) + v.i); }
  double measure(const GridTriangle& t);
  double deviation(const GridTriangle& t) const;

  int level_;
  std::vector<glm::vec3> positions_;  // row by row
  std::vector<float> errors_;
  float finest_error_ = 0.0f;
  glm::dvec3 center_{};
  double radius_ = 0.0;
};

/// Returns true if a triangle must be bisected. `error`: of the triangle. The part of the surface is inside of the ball. A pure function;
/// called from several threads.
using SplitTest = std::function<bool(const glm::dvec3& center, double radius, double error)>;

/// Returns the mesh of a surface in which no triangle needs to be bisected, as far as the patches are measured. patches: one per patch of
/// the grid. Vertices of the edges between patches are repeated, bit for bit. The same mesh for any number of threads.
Mesh adaptive_mesh(const ParametricSurface& surface, const PatchGrid& grid, std::span<const std::shared_ptr<const PatchErrors>> patches,
                   const SplitTest& must_split, const Workers& workers);

}  // namespace halfspace::HS_LANES
