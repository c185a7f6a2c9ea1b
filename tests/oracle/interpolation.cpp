// SPDX-License-Identifier: Apache-2.0
#include "oracle/interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "oracle/arithmetic.h"
#include "oracle/depth.h"

namespace halfspace::oracle {

namespace {

// Returns a plane in which corner 1 is one step in s, and corner 2 is one step in t, from the origin of the point coordinate.
Surface point_surface(const WindowTriangle& t) {
  const auto f = [](int64_t v) { return static_cast<float>(v); };
  const bool from_top = t.origin == PointOrigin::upper_left;
  const int64_t height = from_top ? t.low.y - t.high.y : t.high.y - t.low.y;
  Surface s{};
  s.lanes = {f(t.low.x),
             f(from_top ? t.high.y : t.low.y),
             f(t.high.x - t.low.x),
             0.0f,
             0.0f,
             f(height),
             f((t.high.x - t.low.x) * height),
             0.0f,
             0.0f,
             0.0f,
             0.0f};
  const int exponent = std::max(std::ilogb(t.corner[0].inv_w), -127);
  s.lanes.q0 = s.lanes.q1 = s.lanes.q2 = std::ldexp(t.corner[0].inv_w, -exponent);
  s.lanes.q_unscale = exponent == -127 ? 0.0f : std::ldexp(1.0f, exponent);
  s.value0 = t.corner[0].varyings;
  s.delta1.assign(s.value0.size(), 0.0f);
  s.delta2 = s.delta1;
  return s;
}

}  // namespace

Surface make_surface(const WindowTriangle& t, std::span<const Interpolation> interpolations) {
  if (t.is_point) return point_surface(t);
  std::array<const Corner*, 3> c{&t.corner[0], &t.corner[1], &t.corner[2]};
  const auto farthest = std::min_element(c.begin(), c.end(), [](const Corner* a, const Corner* b) { return a->inv_w < b->inv_w; });
  std::rotate(c.begin(), farthest, c.end());
  Surface s{};
  TriangleLanes<float>& l = s.lanes;
  l.x0 = static_cast<float>(c[0]->x);
  l.y0 = static_cast<float>(c[0]->y);
  l.e1x = static_cast<float>(c[1]->x - c[0]->x);
  l.e1y = static_cast<float>(c[1]->y - c[0]->y);
  l.e2x = static_cast<float>(c[2]->x - c[0]->x);
  l.e2y = static_cast<float>(c[2]->y - c[0]->y);
  l.area = determinant(l.e1x, l.e2y, l.e1y, l.e2x);
  // Scale by a power of two so that the largest 1/w is in [1, 2), or below 1 if it is a denormal.
  const float largest = std::max({c[0]->inv_w, c[1]->inv_w, c[2]->inv_w});
  const int exponent = std::max(std::ilogb(largest), -127);
  l.q0 = std::ldexp(c[0]->inv_w, -exponent);
  l.q1 = std::ldexp(c[1]->inv_w, -exponent);
  l.q2 = std::ldexp(c[2]->inv_w, -exponent);
  l.q_unscale = exponent == -127 ? 0.0f : std::ldexp(1.0f, exponent);
  for (std::size_t i = 0; i < interpolations.size(); ++i) {
    const bool flat = interpolations[i] == Interpolation::flat;
    s.value0.push_back(flat ? t.flat[i] : c[0]->varyings[i]);
    s.delta1.push_back(flat ? 0.0f : c[1]->varyings[i] - c[0]->varyings[i]);
    s.delta2.push_back(flat ? 0.0f : c[2]->varyings[i] - c[0]->varyings[i]);
  }
  return s;
}

namespace {

// The part of a triangle's extent along one axis that lies in a cell of 64 pixels, in 1/256 px.
struct CellPart {
  int64_t begin, end;

  int64_t center() const { return begin + (end - begin) / 2; }
  double reach() const { return static_cast<double>(end - center()); }
};

CellPart part_in_cell(int64_t a, int64_t b, int64_t c, int64_t cell) {
  const int64_t low = cell * kCellSize * 256;
  return {std::max(std::min({a, b, c}), low), std::min(std::max({a, b, c}), low + kCellSize * 256)};
}

// A barycentric weight as a plane, relative to the center of the part of the cell.
struct WeightPlane {
  double at_center, along_x, along_y;

  // Whether the rounding errors of a value that is 1 at this vertex and −1 at the others stay below 5 · 2^-24. The errors are those of the
  // value at the center, the step along x, the step along y, the sum of the first two, and the result:
  // |1 − 2 · at_center| + step_x + step_y + (1 + step_y) + 1.
  bool is_accurate(const CellPart& x, const CellPart& y) const {
    const double step_x = 2 * std::abs(along_x) * x.reach(), step_y = 2 * std::abs(along_y) * y.reach();
    return std::abs(1 - 2 * at_center) + step_x + 2 * step_y <= 3;
  }
};

}  // namespace

// If w is constant, the values of a large triangle are evaluated as planes. They are relative to the center of the part of the cell that
// the triangle's bounding box overlaps. Planes are not used if the rounding errors of some values could exceed 5 · 2^-24 of the largest
// value.
Surface surface_in_cell(const WindowTriangle& t, const Surface& whole, std::span<const Interpolation> interpolations, int64_t cell_x,
                        int64_t cell_y) {
  const auto& [a, b, c] = t.corner;
  if (t.is_point || t.is_line || a.inv_w != b.inv_w || a.inv_w != c.inv_w || is_small(t)) return whole;
  const CellPart x = part_in_cell(a.x, b.x, c.x, cell_x), y = part_in_cell(a.y, b.y, c.y, cell_y);
  const double scale = 1.0 / static_cast<double>((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  // Returns the weight of the vertex opposite to the edge from `from` to `to`.
  const auto weight = [&](const Corner& from, const Corner& to) {
    const int64_t ex = to.x - from.x, ey = to.y - from.y;
    return WeightPlane{static_cast<double>(ex * (y.center() - from.y) - ey * (x.center() - from.x)) * scale,
                       static_cast<double>(-ey) * scale, static_cast<double>(ex) * scale};
  };
  const WeightPlane of_b = weight(c, a), of_c = weight(a, b);
  const WeightPlane of_a{1.0 - (of_b.at_center + of_c.at_center), of_b.along_x + of_c.along_x, of_b.along_y + of_c.along_y};
  if (!of_a.is_accurate(x, y) || !of_b.is_accurate(x, y) || !of_c.is_accurate(x, y)) return whole;
  Surface s = whole;
  s.lanes = TriangleLanes<float>{.x0 = static_cast<float>(x.center()),
                                 .y0 = static_cast<float>(y.center()),
                                 .e1x = 0,
                                 .e1y = 0,
                                 .e2x = 0,
                                 .e2y = 0,
                                 .area = 1,
                                 .q0 = whole.lanes.q0,
                                 .q1 = whole.lanes.q1,
                                 .q2 = whole.lanes.q2,
                                 .q_unscale = whole.lanes.q_unscale,
                                 .planar = true};
  for (std::size_t i = 0; i < interpolations.size(); ++i) {
    if (interpolations[i] == Interpolation::flat) continue;
    const double first{a.varyings[i]}, to_b = double{b.varyings[i]} - first, to_c = double{c.varyings[i]} - first;
    s.value0[i] = static_cast<float>(first + (of_b.at_center * to_b + of_c.at_center * to_c));
    s.delta1[i] = static_cast<float>(of_b.along_x * to_b + of_c.along_x * to_c);
    s.delta2[i] = static_cast<float>(of_b.along_y * to_b + of_c.along_y * to_c);
  }
  return s;
}

namespace {

// Returns the sum of three numbers, and the fractions of the second and the third. Rounding can keep the three fractions from adding up to
// 1; the difference is distributed in proportion to the fractions.
std::array<float, 3> share(const std::array<float, 3>& n) {
  const float sum = n[0] + (n[1] + n[2]);
  const float inverse = 1.0f / sum;
  const float second = n[1] * inverse, third = n[2] * inverse;
  const bool second_is_larger = second > third;
  const float larger = second_is_larger ? second : third, smaller = second_is_larger ? third : second;
  const float missing = std::fma(-n[0], inverse, (1.0f - larger) - smaller);
  return {sum, std::fma(second, missing, second), std::fma(third, missing, third)};
}

}  // namespace

SurfacePoint surface_point(const Surface& s, const WindowTriangle& t, const DepthState& state, const Point& at) {
  const TriangleLanes<float>& l = s.lanes;
  SurfacePoint p{};
  p.dx = static_cast<float>(at.x) - l.x0;
  p.dy = static_cast<float>(at.y) - l.y0;
  // Shaders receive the depth from float determinants, even for triangles whose tested depth uses exact integers.
  const auto [z1, z2] = t.is_point ? std::pair{0.0f, 0.0f} : float_determinants(t, at);
  p.z = depth_sum(t, state, z1, z2);
  if (l.planar) {
    p.weights = {p.dx, p.dy, p.dx, p.dy, l.q0, 256.0f, 0.0f, 0.0f, 256.0f};
    return p;
  }
  const float e0 = determinant(l.e1x - p.dx, l.e2y - p.dy, l.e1y - p.dy, l.e2x - p.dx);
  const float e1 = determinant(p.dx, l.e2y, p.dy, l.e2x);
  const float e2 = determinant(l.e1x, p.dy, l.e1y, p.dx);
  const std::array<float, 3> linear = share({e0, e1, e2});
  const std::array<float, 3> perspective = share({e0 * l.q0, e1 * l.q1, e2 * l.q2});
  // See weight_slopes in shading/pixel.h.
  const float inverse = 1.0f / perspective[0];
  const float per_x = 256.0f * l.area * inverse * inverse, per_y = -256.0f * l.area * inverse * inverse;
  p.weights = {perspective[1],
               perspective[2],
               linear[1],
               linear[2],
               perspective[0],
               l.q1 * per_x * determinant(l.q2, p.dy, l.q0, p.dy - l.e2y),
               l.q2 * per_x * determinant(l.q0, p.dy - l.e1y, l.q1, p.dy),
               l.q1 * per_y * determinant(l.q2, p.dx, l.q0, p.dx - l.e2x),
               l.q2 * per_y * determinant(l.q0, p.dx - l.e1x, l.q1, p.dx)};
  return p;
}

float component_at(const Surface& s, const SurfacePoint& p, Interpolation mode, std::size_t i) {
  if (mode == Interpolation::flat) return s.value0[i];
  const float w1 = mode == Interpolation::linear ? p.weights.b1 : p.weights.p1;
  const float w2 = mode == Interpolation::linear ? p.weights.b2 : p.weights.p2;
  return std::fma(w2, s.delta2[i], std::fma(w1, s.delta1[i], s.value0[i]));
}

}  // namespace halfspace::oracle
