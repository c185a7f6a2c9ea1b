// SPDX-License-Identifier: Apache-2.0
//
// Meshes of a surface that are fine only where a view needs it.
//
// The surface is measured in squares (measured_square.h). A square that is too coarse for the view is divided into quarters, and these are
// measured. The view then decides which triangles are bisected (patch_grid.h). A bisected triangle brings those parts of its neighbors with
// it that keep the mesh free of cracks; those are finer than the view needs.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "halfspace/core/parallel.h"
#include "halfspace/geometry/measured_square.h"
#include "halfspace/geometry/mesh.h"
#include "halfspace/geometry/parametric_surface.h"
#include "halfspace/geometry/patch_grid.h"

namespace halfspace::HS_LANES {

/// The error of a mesh as a view sees it.
struct ViewedError {
  /// Returns the viewed error of a triangle, for example in pixels. `error`: of the triangle. The surface above it is inside of the ball.
  /// Must not decrease with the error or the radius. A pure function; called from several threads.
  std::function<double(const glm::dvec3& center, double radius, double error)> of;
  double allowed = 0.0;  ///< triangles with a larger viewed error are bisected
  /// Returns how far the surface may be from a grid with these numbers of columns and rows between its vertices. Added to all errors. Must
  /// not increase with the numbers.
  std::function<double(int columns, int rows)> between = [](int, int) { return 0.0; };
};

struct AdaptiveMesh {
  Mesh mesh;
  /// The largest viewed error of a triangle. It exceeds the allowed one if the surface would have to be measured more finely than the
  /// limits of AdaptiveSurface permit; then, for the smallest triangles, it is estimated as half the error of a triangle of twice the size.
  double error = 0.0;
  int columns = 0, rows = 0;  ///< of a regular grid that is as fine as the finest square
};

/// A surface and the squares of it that have been measured for earlier views.
class AdaptiveSurface {
 public:
  /// The surface must outlive this object. The grid has at least one column and one row.
  AdaptiveSurface(const ParametricSurface& surface, const PatchGrid& grid);
  AdaptiveSurface(const AdaptiveSurface&) = delete;
  AdaptiveSurface& operator=(const AdaptiveSurface&) = delete;

  /// A patch has at least 16 cells per side, and at most 2^kMaxDepth times as many.
  static constexpr int kMaxDepth = 5;
  /// Squares are not divided further if a view would need more than this number. Squares of earlier views are kept up to the same number.
  static constexpr std::size_t kMaxSquares = 40000;

  /// Returns the mesh for a view: the same for any number of threads, and whatever has been measured before. Vertices of the edges between
  /// patches are repeated, bit for bit. One thread at a time. Throws LimitError, whose message begins with `place`, if the memory is not
  /// available.
  AdaptiveMesh mesh(const ViewedError& viewed, const Workers& workers, const std::string& place);

 private:
  class SplitFinder;
  using Squares = std::map<uint64_t, MeasuredSquare>;  // by place in the patch

  const ParametricSurface& surface_;
  PatchGrid grid_;
  std::vector<Squares> squares_;  // by patch
};

}  // namespace halfspace::HS_LANES
