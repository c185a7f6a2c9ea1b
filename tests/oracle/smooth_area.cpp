// SPDX-License-Identifier: Apache-2.0
#include "oracle/smooth_area.h"

#include <algorithm>
#include <cmath>

namespace halfspace::oracle {

namespace {

glm::dvec2 place(const Corner& c) { return {static_cast<double>(c.x) / 256.0, static_cast<double>(c.y) / 256.0}; }

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Returns the part of a polygon in which the coordinate on an axis is not below 0 or, if `above`, not above 1.
std::vector<glm::dvec2> cut(const std::vector<glm::dvec2>& polygon, int axis, bool above) {
  std::vector<glm::dvec2> out;
  const auto inside_by = [&](const glm::dvec2& p) { return above ? 1.0 - p[axis] : p[axis]; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = inside_by(a), db = inside_by(b);
    if (da >= 0.0) out.push_back(a);
    if ((da < 0.0) != (db < 0.0)) out.push_back((da * b - db * a) / (da - db));
  }
  return out;
}

}  // namespace

std::vector<glm::dvec2> smooth_triangle(const std::array<Corner, 3>& c) { return {place(c[0]), place(c[1]), place(c[2])}; }

std::vector<glm::dvec2> smooth_line(const Corner& nearer, const Corner& farther, float width) {
  const glm::dvec2 a = place(nearer), b = place(farther), d = b - a;
  const glm::dvec2 along = d / std::sqrt(d.x * d.x + d.y * d.y);
  const glm::dvec2 side = 0.5 * static_cast<double>(width) * glm::dvec2(-along.y, along.x);
  return {a - side, b - side, b + side, a + side};
}

Box smooth_box(const std::vector<glm::dvec2>& polygon) {
  glm::dvec2 low = polygon[0], high = polygon[0];
  for (const glm::dvec2& p : polygon) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const auto pixel = [](double v) { return static_cast<int64_t>(v); };
  return {pixel(std::floor(low.x)), pixel(std::floor(low.y)), pixel(std::ceil(high.x)), pixel(std::ceil(high.y))};
}

float smooth_area(const std::vector<glm::dvec2>& polygon, int64_t x, int64_t y) {
  const glm::dvec2 corner(static_cast<double>(x), static_cast<double>(y));
  bool is_whole = true;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    // E is twice the area between the edge and a point; it changes by at most `reach` from the center of the pixel to its corners.
    const glm::dvec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double e = cross(edge, corner + 0.5 - polygon[i]), reach = 0.5 * (std::fabs(edge.x) + std::fabs(edge.y));
    if (e <= -reach) return 0.0f;
    if (e < reach) is_whole = false;
  }
  if (is_whole) return 1.0f;
  std::vector<glm::dvec2> part;
  for (const glm::dvec2& p : polygon) part.push_back(p - corner);
  for (const int axis : {0, 1}) part = cut(cut(part, axis, false), axis, true);
  double twice = 0.0;
  for (std::size_t i = 2; i < part.size(); ++i) twice += cross(part[i - 1] - part[0], part[i] - part[0]);
  return static_cast<float>(std::clamp(0.5 * twice, 0.0, 1.0));
}

}  // namespace halfspace::oracle
