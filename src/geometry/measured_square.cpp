// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/measured_square.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halfspace::HS_LANES {

namespace {

// Twice the signed area of a triangle of grid vertices.
int cross(GridVertex a, GridVertex b, GridVertex c) { return (b.i - a.i) * (c.j - a.j) - (b.j - a.j) * (c.i - a.i); }

float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

}  // namespace

MeasuredSquare::MeasuredSquare(const ParametricSurface& surface, const PatchGrid& grid, const SquarePlace& place) {
  const int level = place.depth + kLevel;
  std::array<double, kCells + 1> u, v;
  for (int i = 0; i <= kCells; ++i) {
    u[static_cast<std::size_t>(i)] = grid.u(place.patch, place.x * kCells + i, level);
    v[static_cast<std::size_t>(i)] = grid.v(place.patch, place.y * kCells + i, level);
  }
  surface.positions(u, v, positions_);
  for (const glm::vec3& p : positions_) center_ += glm::dvec3(p) / static_cast<double>(kVertices);
  for (const glm::vec3& p : positions_) radius_ = std::max(radius_, glm::distance(glm::dvec3(p), center_));
  for (const int half : {0, 1}) measure(square_half(half, kCells, place.is_falling()));
}

// Returns the error of a triangle, not less than that of its parts, and stores it at the vertex that bisects the triangle.
double MeasuredSquare::measure(const GridTriangle& t) {
  if (!t.can_split()) return 0.0;
  const double parts = std::max(measure(t.first()), measure(t.second())), own = deviation(t);
  float& error = errors_[index(t.split())];
  error = std::max(error, rounded_up(std::max(own, parts)));
  if (!t.first().can_split()) finest_error_ = std::max(finest_error_, rounded_up(own));
  if (std::abs(cross(t.apex, t.b, t.c)) == 4) coarse_cell_error_ = std::max(coarse_cell_error_, rounded_up(own));
  return std::max(own, parts);
}

// Returns the largest distance between a vertex of the grid in a triangle and the point of the triangle with the same (u, v).
double MeasuredSquare::deviation(const GridTriangle& t) const {
  const glm::dvec3 apex(position(t.apex)), to_b = glm::dvec3(position(t.b)) - apex, to_c = glm::dvec3(position(t.c)) - apex;
  const int area = cross(t.apex, t.b, t.c), sign = area < 0 ? -1 : 1;
  const double unit = 1.0 / (sign * area);
  const auto [i0, i1] = std::minmax({t.apex.i, t.b.i, t.c.i});
  const auto [j0, j1] = std::minmax({t.apex.j, t.b.j, t.c.j});
  double largest = 0.0;
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const int b = sign * cross(t.apex, {i, j}, t.c), c = sign * cross(t.apex, t.b, {i, j});  // barycentric coordinates, times the area
      if (b < 0 || c < 0 || b + c > sign * area) continue;
      const glm::dvec3 flat = apex + (b * unit) * to_b + (c * unit) * to_c;
      const glm::dvec3 off = glm::dvec3(position({i, j})) - flat;
      largest = std::max(largest, glm::dot(off, off));
    }
  }
  return std::sqrt(largest);
}

}  // namespace halfspace::HS_LANES
