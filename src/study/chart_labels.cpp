// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "halfspace/study/chart.h"

namespace halfspace {

namespace {

constexpr double kLineHeight = 15.0;  // px
constexpr double kPoint = 5.0;        // radius of a point, px

double overlap(const ChartBox& a, const ChartBox& b) {
  return std::max(0.0, std::min(a.x1, b.x1) - std::max(a.x0, b.x0)) * std::max(0.0, std::min(a.y1, b.y1) - std::max(a.y0, b.y0));
}

ChartBox box_of(const LabelPlace& p, double width) {
  const double x0 = p.anchor > 0 ? p.x : p.anchor < 0 ? p.x - width : p.x - 0.5 * width;
  return {x0, p.y - 0.5 * kLineHeight, x0 + width, p.y + 0.5 * kLineHeight};
}

// Lists the positions to try: right, left, above, below and the four corners, then the same at larger distances.
std::vector<LabelPlace> candidates(const glm::dvec2& p) {
  std::vector<LabelPlace> list;
  for (const double r : {9.0, 20.0, 34.0, 50.0, 70.0}) {
    const bool far = r > 9.0;
    const double up = far ? r : r + 3.0, aside = far ? 0.7 * r : r - 3.0;
    list.insert(list.end(), {{p.x + r, p.y, 1, far}, {p.x - r, p.y, -1, far}, {p.x, p.y + up, 0, far}, {p.x, p.y - up, 0, far}});
    for (const double y : {up, -up}) list.insert(list.end(), {{p.x + aside, p.y + 0.8 * y, 1, far}, {p.x - aside, p.y + 0.8 * y, -1, far}});
  }
  return list;
}

}  // namespace

std::vector<LabelPlace> place_labels(const std::vector<glm::dvec2>& points, const std::vector<double>& widths, const ChartBox& room) {
  std::vector<LabelPlace> places;
  std::vector<ChartBox> taken;
  for (const glm::dvec2& p : points) taken.push_back({p.x - kPoint, p.y - kPoint, p.x + kPoint, p.y + kPoint});
  for (std::size_t i = 0; i < points.size(); ++i) {
    double min_cost = 1e300;
    LabelPlace best{};
    for (const LabelPlace& place : candidates(points[i])) {
      const ChartBox box = box_of(place, widths[i]);
      const double area = widths[i] * kLineHeight;
      double cost = 3.0 * (area - overlap(box, room)) + (place.far ? 0.01 * area : 0.0);
      for (const ChartBox& other : taken) cost += overlap(box, other);
      cost += 1e-3 * (std::abs(place.x - points[i].x) + std::abs(place.y - points[i].y));
      if (cost >= min_cost) continue;
      min_cost = cost;
      best = place;
    }
    places.push_back(best);
    taken.push_back(box_of(best, widths[i]));
  }
  return places;
}

}  // namespace halfspace
