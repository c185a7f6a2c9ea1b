// SPDX-License-Identifier: Apache-2.0
#include "study/polygon_area.h"

#include <algorithm>
#include <cmath>

namespace halfspace {

namespace {

template <class T>
using Polygon = std::vector<glm::vec<2, T>>;

// Clips a polygon to the half-plane side·(p[axis] − at) >= 0.
template <class T>
Polygon<T> clipped(const Polygon<T>& polygon, int axis, T at, T side) {
  Polygon<T> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const T da = side * (a[axis] - at), db = side * (b[axis] - at);
    if (da >= 0) out.push_back(a);
    if ((da < 0) != (db < 0)) out.push_back(a + (b - a) * (da / (da - db)));
  }
  return out;
}

// Coordinates are relative to the first vertex, which avoids cancellation far from the origin.
template <class T>
T area(const Polygon<T>& polygon) {
  T twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const auto a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

}  // namespace

template <class T>
Image<T> area_coverage(const std::vector<TrianglePx>& triangles, int width, int height) {
  Image<T> share(width, height);
  for (const TrianglePx& t : triangles) {
    const auto [y_low, y_high] = std::minmax({t[0].y, t[1].y, t[2].y});
    for (int y = std::max(0, static_cast<int>(std::floor(y_low))); y < std::min<double>(height, std::ceil(y_high)); ++y) {
      Polygon<T> row;
      for (const glm::dvec2& p : t) row.emplace_back(p);
      row = clipped<T>(clipped<T>(row, 1, T(y), 1), 1, T(y + 1), -1);
      if (row.empty()) continue;
      const auto [left, right] = std::ranges::minmax_element(row, {}, [](const auto& p) { return p.x; });
      const int x1 = std::min(width, static_cast<int>(std::ceil(right->x)));
      for (int x = std::max(0, static_cast<int>(std::floor(left->x))); x < x1; ++x)
        share.at(x, height - 1 - y) += area<T>(clipped<T>(clipped<T>(row, 0, T(x), 1), 0, T(x + 1), -1));
    }
  }
  return share;
}

template Image<double> area_coverage<double>(const std::vector<TrianglePx>&, int, int);
template Image<long double> area_coverage<long double>(const std::vector<TrianglePx>&, int, int);

}  // namespace halfspace
