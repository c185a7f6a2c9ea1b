// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "explain/fragment_evaluator.h"

namespace halfspace {

namespace {

// A point (x, y) in NDC with weights b satisfies Σ bᵢ·(xᵢ, yᵢ, wᵢ) ∝ (x, y, 1), where (xᵢ, yᵢ, wᵢ) are clip-space coordinates.
glm::vec3 weights_of_clipped(const InspectedTriangle& t, const glm::dvec2& position_px) {
  const Viewport& v = t.draw->viewport;
  const glm::dvec3 point((position_px.x - double{v.center_x}) / double{v.half_width},
                         (position_px.y - double{v.center_y}) / double{v.half_height}, 1.0);
  std::array<glm::dvec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec4& c = t.position_cs[i];
    p[i] = {double{c.x}, double{c.y}, double{c.w}};
  }
  // Cramer's rule, without the common determinant.
  const glm::dvec3 b(glm::dot(point, glm::cross(p[1], p[2])), glm::dot(point, glm::cross(p[2], p[0])),
                     glm::dot(point, glm::cross(p[0], p[1])));
  return glm::vec3(b / (b.x + b.y + b.z));
}

// Returns the weights for a line that was converted to triangles: those of the nearest point on the line, or of its first vertex if the
// line begins behind the eye.
glm::vec3 weights_of_wide_line(const InspectedTriangle& t, const glm::dvec2& position_px) {
  const Viewport& v = t.draw->viewport;
  std::array<glm::dvec2, 2> p;
  std::array<double, 2> q;
  for (std::size_t i = 0; i < 2; ++i) {
    const glm::dvec4 c(t.position_cs[i]);
    if (c.w <= 0.0) return {1.0f, 0.0f, 0.0f};
    q[i] = 1.0 / c.w;
    p[i] = {double{v.center_x} + c.x * q[i] * double{v.half_width}, double{v.center_y} + c.y * q[i] * double{v.half_height}};
  }
  const glm::dvec2 along = p[1] - p[0];
  const double at = std::clamp(glm::dot(position_px - p[0], along) / std::max(glm::dot(along, along), 1e-12), 0.0, 1.0);
  const auto second = static_cast<float>(at * q[1] / ((1.0 - at) * q[0] + at * q[1]));
  return {1.0f - second, second, 0.0f};
}

}  // namespace

glm::vec3 submitted_weights(const InspectedTriangle& t, const Weights<float>& weights, const glm::dvec2& position_px) {
  const Triangle& triangle = *t.source.triangle;
  if (triangle.is_point()) return {1.0f, 0.0f, 0.0f};
  if (triangle.is(kClipped) && is_lines(t.draw->state.topology)) return weights_of_wide_line(t, position_px);
  if (triangle.is(kClipped)) return weights_of_clipped(t, position_px);
  const auto inv_w = [&](std::size_t i) { return t.source.vertex[i]->inv_w; };
  std::size_t first = inv_w(1) < inv_w(0) ? 1 : 0;  // the order of triangle_scalars()
  if (inv_w(2) < inv_w(first)) first = 2;
  const std::array<float, 3> p{1.0f - (weights.p1 + weights.p2), weights.p1, weights.p2};
  glm::vec3 out(0.0f);
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t corner = (first + i) % 3;
    if (triangle.is_line() && corner == 2) corner = 0;  // the third vertex of a line has the values of the first
    for (int k = 0; k < 3; ++k) {
      if (t.slot[static_cast<std::size_t>(k)] != triangle.vertex[corner]) continue;
      out[k] += p[i];
      break;
    }
  }
  return out;
}

}  // namespace halfspace
