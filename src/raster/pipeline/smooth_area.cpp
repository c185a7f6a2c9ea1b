// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/pipeline/smooth_area.h"

#include <algorithm>
#include <cmath>

namespace halfspace::HS_LANES {

namespace {

// A convex polygon that is clipped at the sides of a pixel.
struct Polygon {
  std::array<glm::dvec2, 24> corner;  // at most half as many more after each of four clips
  std::size_t count = 0;

  void add(const glm::dvec2& p) { corner[count++] = p; }
};

// Returns the part of a polygon in which distance(p), a linear function, is not negative.
template <class F>
Polygon clipped(const Polygon& polygon, const F& distance) {
  Polygon out;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const glm::dvec2 &a = polygon.corner[i], &b = polygon.corner[(i + 1) % polygon.count];
    const double da = distance(a), db = distance(b);
    if (da >= 0.0) out.add(a);
    if ((da < 0.0) != (db < 0.0)) out.add((da * b - db * a) / (da - db));
  }
  return out;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double area_of(const Polygon& p) {
  double twice = 0.0;
  for (std::size_t i = 2; i < p.count; ++i) twice += cross(p.corner[i - 1] - p.corner[0], p.corner[i] - p.corner[0]);
  return 0.5 * twice;
}

}  // namespace

SmoothArea::SmoothArea(const Draw& draw, const Triangle& t) : count_(t.is_line() ? 4 : 3) {
  const auto corner = [&](std::size_t i) { return glm::dvec2(t.x[i], t.y[i]) / static_cast<double>(kSubPixels); };
  if (!t.is_line()) {
    for (std::size_t i = 0; i < 3; ++i) corners_[i] = corner(i);
    return;
  }
  const glm::dvec2 a = corner(0), b = corner(1), along = (b - a) / glm::length(b - a);
  const glm::dvec2 side = 0.5 * static_cast<double>(draw.state.line_width) * glm::dvec2(-along.y, along.x);
  corners_ = {a - side, b - side, b + side, a + side};
}

double SmoothArea::in_pixel(int x, int y) const {
  const glm::dvec2 origin(x, y), center = origin + 0.5;
  bool is_whole = true;
  for (std::size_t i = 0; i < count_; ++i) {
    const glm::dvec2 edge = corners_[(i + 1) % count_] - corners_[i];
    const double at_center = cross(edge, center - corners_[i]), reach = 0.5 * (std::fabs(edge.x) + std::fabs(edge.y));
    if (at_center <= -reach) return 0.0;
    is_whole &= at_center >= reach;
  }
  if (is_whole) return 1.0;
  Polygon p;
  for (std::size_t i = 0; i < count_; ++i) p.add(corners_[i] - origin);
  p = clipped(p, [](const glm::dvec2& v) { return v.x; });
  p = clipped(p, [](const glm::dvec2& v) { return 1.0 - v.x; });
  p = clipped(p, [](const glm::dvec2& v) { return v.y; });
  p = clipped(p, [](const glm::dvec2& v) { return 1.0 - v.y; });
  return std::clamp(area_of(p), 0.0, 1.0);
}

PixelBounds SmoothArea::pixels(const PixelBounds& bounds) const {
  glm::dvec2 low = corners_[0], high = corners_[0];
  for (std::size_t i = 1; i < count_; ++i) {
    low = min(low, corners_[i]);
    high = max(high, corners_[i]);
  }
  // The corners of a line of the largest width are within 2^15 pixels.
  const auto pixel = [](double x) { return static_cast<int>(x); };
  return {std::max(pixel(std::floor(low.x)), bounds.x0), std::max(pixel(std::floor(low.y)), bounds.y0),
          std::min(pixel(std::ceil(high.x)), bounds.x1), std::min(pixel(std::ceil(high.y)), bounds.y1)};
}

}  // namespace halfspace::HS_LANES
