// SPDX-License-Identifier: Apache-2.0
//
// Finds the triangle of a mesh that is nearest to a point.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// A tree of bounding boxes over the triangles of a mesh. All results are the same on every machine.
class TriangleTree {
 public:
  /// indices: a list of at least one triangle, all in range. Positions must be finite. Neither is kept.
  TriangleTree(std::span<const glm::vec3> positions, std::span<const uint32_t> indices);

  std::size_t size() const { return triangles_.size(); }  ///< number of triangles
  /// Returns the longest side of the bounding box.
  double longest_side() const;

  struct Nearest {
    double squared;     ///< square of the distance
    uint32_t triangle;  ///< a number for distance_squared()
  };
  /// Returns the nearest triangle. hint: a triangle that is likely to be near; the search starts with it, and it wins against others at the
  /// same distance. visits: number of nodes that the function may still visit; it subtracts those that it visits. At 0, it returns the
  /// nearest triangle that it has found.
  Nearest nearest(const glm::dvec3& p, uint32_t hint, int64_t& visits) const;

  /// Returns the square of the distance from a point to a triangle. The distance is exact up to rounding, or too large by less than a
  /// millionth of the longest side if the triangle is so thin that its normal is not reliable.
  double distance_squared(const glm::dvec3& p, uint32_t triangle) const;

 private:
  struct Node {
    glm::vec3 low, high;
    uint32_t first = 0;  // leaf: the first triangle; otherwise the right child, whose left sibling follows its parent
    uint32_t count = 0;  // 0: not a leaf
  };
  using Corners = std::array<glm::vec3, 3>;

  void build(std::span<uint32_t> order, std::span<const Corners> triangles);
  double box_distance_squared(const glm::dvec3& p, uint32_t node) const;

  std::vector<Node> nodes_;
  std::vector<Corners> triangles_;  // in the order of the leaves
};

}  // namespace halfspace::HS_LANES
