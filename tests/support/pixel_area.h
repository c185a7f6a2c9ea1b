// SPDX-License-Identifier: Apache-2.0
//
// A closed form for smooth primitives: the area of a pixel that a convex polygon covers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/core/vec.h"

namespace halfspace {

/// Returns the area of the part of a convex polygon in [x, x + 1] × [y, y + 1]: the integral of the length of its intersection with a
/// vertical line, which is a piecewise linear function between the breakpoints. The trapezoidal rule is exact for such functions.
inline double area_in_pixel(std::span<const glm::dvec2> polygon, int x, int y) {
  const double left = x, bottom = y;
  const auto edge = [&](std::size_t i) { return std::pair(polygon[i], polygon[(i + 1) % polygon.size()]); };
  const auto length = [&](double at_x) {
    double low = 1e9, high = -1e9;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto [a, b] = edge(i);
      if (at_x < std::min(a.x, b.x) || at_x > std::max(a.x, b.x) || a.x == b.x) continue;
      const double at_y = a.y + (b.y - a.y) * (at_x - a.x) / (b.x - a.x);
      low = std::min(low, at_y);
      high = std::max(high, at_y);
    }
    return std::max(0.0, std::min(high, bottom + 1.0) - std::max(low, bottom));
  };
  std::vector<double> breaks{left, left + 1.0};
  const auto add = [&](double b) {
    if (b > left && b < left + 1.0) breaks.push_back(b);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto [a, b] = edge(i);
    add(a.x);
    for (const double side : {bottom, bottom + 1.0}) {
      if (a.y != b.y) add(a.x + (b.x - a.x) * (side - a.y) / (b.y - a.y));
    }
  }
  std::sort(breaks.begin(), breaks.end());
  double area = 0.0;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    // A vertical edge makes the length jump, so the ends are approached from inside.
    const double a = breaks[i - 1], b = breaks[i], inside = (b - a) * 1e-9;
    area += (b - a) * 0.5 * (length(a + inside) + length(b - inside));
  }
  return area;
}

}  // namespace halfspace
