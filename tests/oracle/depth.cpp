// SPDX-License-Identifier: Apache-2.0
#include "oracle/depth.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "oracle/arithmetic.h"

namespace halfspace::oracle {

float depth_sum(const WindowTriangle& t, const DepthState& state, float e1, float e2) {
  const float high = std::max(state.range_near, state.range_far);
  float low = std::min(state.range_near, state.range_far);
  if (t.is_line || !t.smooth.empty()) low = clamped(t.z0, low, high);
  return clamped(std::fma(e1, t.z_step1, std::fma(e2, t.z_step2, t.z0)), low, clamped(t.z_max, low, high));
}

std::pair<float, float> float_determinants(const WindowTriangle& t, const Point& at) {
  const auto& c = t.corner;
  const auto f = [](int64_t v) { return static_cast<float>(v); };
  const float dx = f(at.x - c[0].x), dy = f(at.y - c[0].y);
  return {determinant(dx, f(c[2].y - c[0].y), dy, f(c[2].x - c[0].x)), determinant(f(c[1].x - c[0].x), dy, f(c[1].y - c[0].y), dx)};
}

float tested_depth(const WindowTriangle& t, const DepthState& state, const Point& at) {
  if (t.is_point) return depth_sum(t, state, 0.0f, 0.0f);
  if (!t.is_line && t.smooth.empty() && is_small(t)) {
    const auto& c = t.corner;
    const int64_t dx = at.x - c[0].x, dy = at.y - c[0].y;
    const int64_t e1 = cross(dx, dy, c[2].x - c[0].x, c[2].y - c[0].y);
    const int64_t e2 = cross(c[1].x - c[0].x, c[1].y - c[0].y, dx, dy);
    return depth_sum(t, state, static_cast<float>(e1), static_cast<float>(e2));
  }
  const auto [e1, e2] = float_determinants(t, at);
  return depth_sum(t, state, e1, e2);
}

}  // namespace halfspace::oracle
