// SPDX-License-Identifier: Apache-2.0
#include "oracle/triangle_setup.h"

#include <algorithm>
#include <cmath>

#include "oracle/arithmetic.h"
#include "oracle/coverage.h"
#include "oracle/smooth_area.h"

namespace halfspace::oracle {

int64_t orient2d(const Corner& a, const Corner& b, const Corner& c) { return cross(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y); }

std::vector<std::array<Corner, 3>> fan(const std::vector<Corner>& polygon) {
  std::vector<std::array<Corner, 3>> pieces;
  for (std::size_t apex = 0; apex < polygon.size(); ++apex) {
    std::vector<Corner> from(polygon);
    std::rotate(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(apex), from.end());
    pieces.clear();
    int64_t area = 0;
    for (std::size_t i = 2; i < from.size(); ++i) {
      pieces.push_back({from[0], from[i - 1], from[i]});
      area += orient2d(from[0], from[i - 1], from[i]);
    }
    const auto against = [area](const std::array<Corner, 3>& p) {
      const int64_t own = orient2d(p[0], p[1], p[2]);
      return own != 0 && (own > 0) != (area > 0);
    };
    if (std::none_of(pieces.begin(), pieces.end(), against)) break;
    if (apex + 1 == polygon.size()) std::erase_if(pieces, against);
  }
  return pieces;
}

bool culls_face(CullMode mode, bool front) {
  return mode == CullMode::front_and_back || (mode == CullMode::front && front) || (mode == CullMode::back && !front);
}

namespace {

// Polygon offset, OpenGL 4.6, section 14.6.5. dz1 and dz2 are the depths of vertices 1 and 2 relative to vertex 0.
float polygon_offset(const DepthOffset& o, DepthFormat format, const WindowTriangle& t, double dz1, double dz2) {
  double offset = 0.0;
  const auto dx = [&](std::size_t i) { return static_cast<double>(t.corner[i].x - t.corner[0].x); };
  const auto dy = [&](std::size_t i) { return static_cast<double>(t.corner[i].y - t.corner[0].y); };
  const double area = static_cast<double>(t.area);
  if (o.slope != 0.0f) {
    const double by_x = std::fabs((dy(2) * dz1 - dy(1) * dz2) / area * 256.0);
    const double by_y = std::fabs((dx(1) * dz2 - dx(2) * dz1) / area * 256.0);
    offset = static_cast<double>(o.slope) * std::fmax(by_x, by_y);
  }
  double unit = 1.0 / 16777215.0;
  if (format == DepthFormat::d16) unit = 1.0 / 65535.0;
  if (format == DepthFormat::d32f || format == DepthFormat::d32fs8 || format == DepthFormat::none) {
    float largest = 0.0f;
    for (const Corner& c : t.corner) largest = std::fmax(largest, std::fabs(c.z));
    unit = std::ldexp(1.0, largest > 0.0f ? std::ilogb(largest) - 23 : -149);
  }
  offset += static_cast<double>(o.constant) * unit;
  if (o.clamp > 0.0f) offset = std::fmin(offset, static_cast<double>(o.clamp));
  if (o.clamp < 0.0f) offset = std::fmax(offset, static_cast<double>(o.clamp));
  return static_cast<float>(offset);
}

}  // namespace

float outline_offset(const DepthOffset& o, DepthFormat format, const std::array<Corner, 3>& corners) {
  WindowTriangle t;
  t.corner = corners;
  const auto& c = corners;
  t.area = cross(c[1].x - c[0].x, c[1].y - c[0].y, c[2].x - c[0].x, c[2].y - c[0].y);
  if (t.area == 0) return 0.0f;
  return polygon_offset(o, format, t, static_cast<double>(c[1].z) - static_cast<double>(c[0].z),
                        static_cast<double>(c[2].z) - static_cast<double>(c[0].z));
}

std::pair<Fate, WindowTriangle> make_window_triangle(const DrawState& state, const Box& allowed, DepthFormat format, int samples,
                                                     const std::array<Corner, 3>& submitted, std::size_t provoking,
                                                     std::optional<bool> faces_front) {
  WindowTriangle t;
  t.corner = submitted;
  t.flat = submitted[provoking].varyings;
  auto& c = t.corner;
  t.area = cross(c[1].x - c[0].x, c[1].y - c[0].y, c[2].x - c[0].x, c[2].y - c[0].y);
  if (t.area == 0) return {Fate::degenerate, t};
  const bool counter_clockwise = t.area > 0;
  t.front = is_front_facing(state, counter_clockwise);
  if (faces_front) t.front = *faces_front;
  if (!faces_front && culls_face(state.cull, t.front)) return {Fate::wrong_face, t};
  const bool smooth = samples == 1 && is_smooth(state);
  if (smooth) t.smooth = smooth_triangle(c);
  if (intersect(covered_box(t, samples), allowed).empty()) return {Fate::no_sample, t};
  if (!counter_clockwise) {
    std::swap(c[1], c[2]);
    t.area = -t.area;
  }
  // The vertex with the smallest depth comes first. Among equal ones, it is the first in counter-clockwise order, starting from the first
  // submitted vertex.
  const auto nearest = std::min_element(c.begin(), c.end(), [](const Corner& a, const Corner& b) { return a.z < b.z; });
  std::rotate(c.begin(), nearest, c.end());
  if (smooth) t.smooth = smooth_triangle(c);
  if (samples == 1 && !smooth && covers_none_of_few(t, intersect(covered_box(t, samples), allowed))) return {Fate::no_sample, t};
  const double dz1 = static_cast<double>(c[1].z) - static_cast<double>(c[0].z);
  const double dz2 = static_cast<double>(c[2].z) - static_cast<double>(c[0].z);
  const float offset = faces_front || !state.offset.fill ? 0.0f : polygon_offset(state.offset, format, t, dz1, dz2);
  t.z0 = c[0].z + offset;
  t.z_max = std::max({c[0].z, c[1].z, c[2].z}) + offset;
  t.z_step1 = static_cast<float>(dz1 / static_cast<double>(t.area));
  t.z_step2 = static_cast<float>(dz2 / static_cast<double>(t.area));
  return {Fate::drawn, t};
}

}  // namespace halfspace::oracle
