// SPDX-License-Identifier: Apache-2.0
//
// The vertices and triangles of adaptive meshes: the unit square is divided into patches, each patch into two right triangles, and every
// triangle can be bisected at the middle of its hypotenuse, any number of times (newest vertex bisection; Duchaineau et al., ROAMing
// Terrain, IEEE Visualization 1997).
//
//   north-west ──── north-east     A vertex bisects the two triangles on both sides of a hypotenuse. Their right angles are at its
//       │  ╲            │          parents. A set of vertices that contains the parents of each of its members is a mesh without
//       │     ╲         │          cracks, because no triangle is bisected without its neighbor.
//       │        ╲      │
//   south-west ──── south-east
//
// u grows to the east and v to the south. With patches of n = 2^level cells per side, the vertex (i, j) is at u = i / (columns · n),
// v = j / (rows · n).
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// A vertex of the grid.
struct GridVertex {
  int i = 0, j = 0;
  bool operator==(const GridVertex&) const = default;
};

inline GridVertex middle(GridVertex a, GridVertex b) { return {(a.i + b.i) / 2, (a.j + b.j) / 2}; }

/// A triangle, counter-clockwise seen from outside. Its right angle is at the apex.
struct GridTriangle {
  GridVertex apex, b, c;

  /// Returns true if the middle of the hypotenuse is a vertex of the grid.
  bool can_split() const { return ((b.i + c.i) % 2 == 0) && ((b.j + c.j) % 2 == 0); }
  GridVertex split() const { return middle(b, c); }
  GridTriangle first() const { return {split(), apex, b}; }
  GridTriangle second() const { return {split(), c, apex}; }
};

/// The patches of a surface.
struct PatchGrid {
  int columns = 1, rows = 1;                ///< number of patches along u and v
  bool closed_u = false, closed_v = false;  ///< the points at u = 0 and u = 1 (v = 0 and v = 1) are the same

  int patches() const { return columns * rows; }
  /// Returns the position of a vertex of a patch. level: of the grid.
  double u(int patch, int i, int level) const { return static_cast<double>(((patch % columns) << level) + i) / (columns << level); }
  double v(int patch, int j, int level) const { return static_cast<double>(((patch / columns) << level) + j) / (rows << level); }
};

/// One of the two halves of a square with n cells per side, number 0 or 1. falling: the diagonal between them runs from the north-west to
/// the south-east, as in patches; otherwise from the north-east to the south-west.
inline GridTriangle square_half(int number, int n, bool falling) {
  if (falling) return number == 0 ? GridTriangle{{0, n}, {n, n}, {0, 0}} : GridTriangle{{n, 0}, {0, 0}, {n, n}};
  return number == 0 ? GridTriangle{{0, 0}, {0, n}, {n, 0}} : GridTriangle{{n, n}, {n, 0}, {0, n}};
}

/// A set of vertices that contains the parents of its members. The corners of the patches are always members.
class GridVertices {
 public:
  /// level: of the grid, at most 12.
  GridVertices(const PatchGrid& grid, int level);

  /// Adds a vertex of a patch, and its parents.
  void add(int patch, GridVertex v);
  /// Returns true for members. Not for corners.
  bool contains(int patch, GridVertex v) const;

 private:
  // A vertex of the whole grid and its bit.
  struct Bit {
    int patch;
    std::size_t index;
  };
  Bit bit_of(GridVertex v) const;
  void add(GridVertex v);
  // Returns false if a vertex is outside of the square. Moves it into the square where that is closed.
  bool wrap(GridVertex& v) const;

  PatchGrid grid_;
  int level_;
  std::vector<std::vector<uint64_t>> bits_;  // by patch; empty if the patch has no members
};

}  // namespace halfspace::HS_LANES
