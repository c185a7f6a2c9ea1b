// SPDX-License-Identifier: Apache-2.0
//
// The errors of the triangles of a square of an adaptive mesh, measured at the vertices of a regular grid.
//
// The error of a triangle is the largest distance between a point of the surface and the point of the triangle with the same (u, v). It
// bounds the distance between the surface and the triangle in both directions, and how far textures are displaced. Here, only the vertices
// of the grid count as points of the surface.
#pragma once

#include <array>
#include <cstddef>

#include "halfspace/geometry/parametric_surface.h"
#include "halfspace/geometry/patch_grid.h"

namespace halfspace::HS_LANES {

/// A square of a patch that has been divided `depth` times into quarters: square (x, y) of 2^depth per side.
struct SquarePlace {
  int patch = 0, depth = 0, x = 0, y = 0;

  SquarePlace quarter(int number) const { return {patch, depth + 1, 2 * x + number % 2, 2 * y + number / 2}; }
  /// Returns true if the diagonal between the halves of the square is that of patches (square_half). Diagonals of quarters meet at the
  /// center of their square.
  bool is_falling() const { return depth == 0 || (x + y) % 2 == 0; }
};

class MeasuredSquare {
 public:
  static constexpr int kLevel = 4, kCells = 1 << kLevel;  ///< per side

  /// The surface is not kept.
  MeasuredSquare(const ParametricSurface& surface, const PatchGrid& grid, const SquarePlace& place);

  const glm::vec3& position(GridVertex v) const { return positions_[index(v)]; }
  /// Returns the error of the triangle in the square that the vertex bisects, or the larger error of two. Not less than the errors of the
  /// parts of these triangles.
  double error(GridVertex v) const { return static_cast<double>(errors_[index(v)]); }
  /// Returns the largest error of the triangles whose hypotenuse is two cells long. Smaller triangles cannot be bisected.
  double finest_error() const { return static_cast<double>(finest_error_); }
  /// Returns the largest error of the triangles whose legs are two cells long: halves of the cells of the square of which this is a
  /// quarter.
  double coarse_cell_error() const { return static_cast<double>(coarse_cell_error_); }
  /// A ball around the vertices.
  const glm::dvec3& center() const { return center_; }
  double radius() const { return radius_; }

 private:
  static std::size_t index(GridVertex v) { return static_cast<std::size_t>(v.j * (kCells + 1) + v.i); }
  double measure(const GridTriangle& t);
  double deviation(const GridTriangle& t) const;

  static constexpr std::size_t kVertices = (kCells + 1) * (kCells + 1);
  std::array<glm::vec3, kVertices> positions_;  // row by row
  std::array<float, kVertices> errors_{};
  float finest_error_ = 0.0f, coarse_cell_error_ = 0.0f;
  glm::dvec3 center_{};
  double radius_ = 0.0;
};

}  // namespace halfspace::HS_LANES
