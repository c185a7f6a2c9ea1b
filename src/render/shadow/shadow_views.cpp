// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/shadow/shadow_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/core/vec.h"
#include "halfspace/geometry/camera.h"

namespace halfspace::HS_LANES {

namespace {

// Clips the segment from a to b to the part where all distances are ≥ 0. Each distance is given as its values at a and b. Returns false if
// nothing is left.
template <class Distances>
bool clip_segment(glm::dvec3& a, glm::dvec3& b, const Distances& distances) {
  double from = 0.0, to = 1.0;
  for (const auto& [at_a, at_b] : distances) {
    if (at_a < 0.0 && at_b < 0.0) return false;
    if (at_a < 0.0) from = std::max(from, at_a / (at_a - at_b));
    if (at_b < 0.0) to = std::min(to, at_a / (at_a - at_b));
  }
  if (from > to) return false;
  const glm::dvec3 way = b - a;
  b = a + way * to;
  a = a + way * from;
  return true;
}

// Visits the twelve edges of a body with eight corners: pairs of corners whose indices differ in one of three bits.
template <class F>
void for_each_edge(F visit) {
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (std::size_t bit = 1; bit < 8; bit *= 2) {
      if ((corner & bit) == 0) visit(corner, corner | bit);
    }
  }
}

struct Plane {
  glm::dvec3 normal;  // points inwards
  double offset;
  double distance(const glm::dvec3& p) const { return glm::dot(normal, p) + offset; }
};

// Returns the six faces of a body with eight corners. Each plane goes through three corners.
std::array<Plane, 6> faces_of(const std::array<glm::dvec3, 8>& c) {
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& p : c) middle += p / 8.0;
  constexpr std::size_t faces[6][3] = {{0, 2, 4}, {1, 3, 5}, {0, 1, 4}, {2, 3, 6}, {0, 1, 2}, {4, 5, 6}};
  std::array<Plane, 6> planes;
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::dvec3 &a = c[faces[i][0]], &b = c[faces[i][1]], &d = c[faces[i][2]];
    glm::dvec3 n = unit_or_zero(glm::cross(b - a, d - a));
    if (glm::dot(n, middle - a) < 0.0) n = -n;
    planes[i] = {n, -glm::dot(n, a)};
  }
  return planes;
}

// Returns the smallest 2^(k/4) ≥ x, for integer k and x > 0.
double next_step(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // x = mantissa · 2^exponent, mantissa in [1/2, 1)
  constexpr double steps[] = {0.5, 0.59460355750136051, 0.70710678118654757, 0.84089641525371450, 1.0};
  return std::ldexp(*std::ranges::lower_bound(steps, mantissa), exponent);
}

LightView perspective_view(const glm::dvec3& position, const glm::dvec3& forward, const glm::dvec3& up, double tan_half, double near,
                           double far, int size, double margin) {
  const double widened = tan_half * size / (size - 2.0 * margin);
  const double a = near * far / (far - near), b = -near / (far - near);  // window depth = a/w + b
  const glm::dmat4 clip_from_view(glm::dvec4(1.0 / widened, 0, 0, 0), glm::dvec4(0, 1.0 / widened, 0, 0), glm::dvec4(0, 0, -b, -1),
                                  glm::dvec4(0, 0, a, 0));
  return {clip_from_view * look_at(position, position + forward, up), 2.0 * widened / size, a, true, near, far};
}

}  // namespace

std::array<glm::dvec3, 8> corners_of(const Box& box) {
  std::array<glm::dvec3, 8> c;
  for (std::size_t i = 0; i < 8; ++i)
    c[i] = {(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y, (i & 4) != 0 ? box.high.z : box.low.z};
  return c;
}

glm::dmat3 light_axes(const glm::dvec3& to_light_ws) {
  const glm::dvec3 back = unit_or_zero(to_light_ws);
  const glm::dvec3 side = std::abs(back.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
  const glm::dvec3 right = unit_or_zero(glm::cross(side, back));
  return {right, glm::cross(back, right), back};
}

std::array<glm::dvec3, 8> frustum_corners(const glm::dmat4& clip_from_world) {
  const glm::dmat4 world_from_clip = glm::inverse(clip_from_world);
  std::array<glm::dvec3, 8> c;
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::dvec4 p = world_from_clip * glm::dvec4((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 0 : 1, 1);
    c[i] = glm::dvec3(p) / p.w;
  }
  return c;
}

std::array<glm::dvec3, 8> frustum_corners(const View& view) {
  if (view.to_eye_ws != glm::dvec3(0.0)) return frustum_corners(view.clip_from_world);  // orthographic
  std::array<glm::dvec3, 8> c;
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::dvec3 side_ws = (i & 1) != 0 ? view.ray_x_ws : -view.ray_x_ws, up_ws = (i & 2) != 0 ? view.ray_y_ws : -view.ray_y_ws;
    c[i] = view.eye_ws + ((i & 4) != 0 ? view.far : view.near) * (view.ray_ws + side_ws + up_ws);
  }
  return c;
}

std::array<glm::dvec3, 8> frustum_slice(const std::array<glm::dvec3, 8>& frustum, double from, double to) {
  std::array<glm::dvec3, 8> c;
  for (std::size_t i = 0; i < 4; ++i) {
    c[i] = glm::mix(frustum[i], frustum[i + 4], from);
    c[i + 4] = glm::mix(frustum[i], frustum[i + 4], to);
  }
  return c;
}

std::vector<glm::dvec3> common_corners(const std::array<glm::dvec3, 8>& frustum, const Box& box_ws) {
  const std::array<glm::dvec3, 8> box = corners_of(box_ws);
  const std::array<Plane, 6> of_frustum = faces_of(frustum);
  std::vector<glm::dvec3> corners;
  const auto keep_edges = [&](const std::array<glm::dvec3, 8>& body, const auto& planes) {
    for_each_edge([&](std::size_t i, std::size_t j) {
      glm::dvec3 a = body[i], b = body[j];
      std::array<std::pair<double, double>, 6> distances;
      for (std::size_t k = 0; k < 6; ++k) distances[k] = {planes[k].distance(a), planes[k].distance(b)};
      if (clip_segment(a, b, distances)) corners.insert(corners.end(), {a, b});
    });
  };
  std::array<Plane, 6> of_box;
  for (glm::length_t k = 0; k < 3; ++k) {
    glm::dvec3 axis(0.0);
    axis[k] = 1.0;
    of_box[static_cast<std::size_t>(2 * k)] = {axis, -box_ws.low[k]};
    of_box[static_cast<std::size_t>(2 * k + 1)] = {-axis, box_ws.high[k]};
  }
  keep_edges(frustum, of_box);
  keep_edges(box, of_frustum);
  return corners;
}

LightView directional_view(const glm::dmat3& axes, const Box& receivers, std::span<const Box> casters, int size, double margin) {
  const double wanted = std::max({receivers.high.x - receivers.low.x, receivers.high.y - receivers.low.y, 1e-6});
  // One additional texel on each side leaves room for snapping the origin.
  const double texel = next_step(wanted / (size - 2.0 * margin - 2.0));
  const double width = texel * size;
  const auto start = [&](double low, double high) { return std::floor((0.5 * (low + high) - 0.5 * width) / texel) * texel; };
  const double x0 = start(receivers.low.x, receivers.high.x), y0 = start(receivers.low.y, receivers.high.y);
  double nearest = receivers.high.z;
  for (const Box& c : casters) {
    const bool over = c.low.x <= x0 + width && c.high.x >= x0 && c.low.y <= y0 + width && c.high.y >= y0;
    if (over) nearest = std::max(nearest, c.high.z);
  }
  // A margin of one texel in depth at both ends, so that rounding does not clip them.
  const double near = nearest + texel, far = receivers.low.z - texel;
  const double depth = near - far;
  const glm::dmat4 along_axes(glm::transpose(axes));
  glm::dmat4 clip_from_axes(1.0);
  clip_from_axes[0][0] = clip_from_axes[1][1] = 2.0 / width;
  clip_from_axes[2][2] = 1.0 / depth;
  clip_from_axes[3] = glm::dvec4(-1.0 - 2.0 * x0 / width, -1.0 - 2.0 * y0 / width, -far / depth, 1.0);
  return {clip_from_axes * along_axes, texel, 1.0 / depth, false, 0.0, depth};
}

LightView spot_view(const glm::dvec3& position, const glm::dvec3& forward, double angle, double near, double far, int size, double margin) {
  const SinCosDouble half = sincos_radians(0.5 * angle);
  return perspective_view(position, forward, light_axes(-forward)[1], half.sin / half.cos, near, far, size, margin);
}

std::array<LightView, 6> cube_views(const glm::dvec3& position, double near, double far, int size, double margin) {
  std::array<LightView, 6> views;
  for (std::size_t i = 0; i < 6; ++i) {
    glm::dvec3 forward(0.0), up(0.0);
    forward[static_cast<glm::length_t>(i / 2)] = i % 2 == 0 ? 1.0 : -1.0;
    up[i / 2 == 1 ? 2 : 1] = 1.0;
    views[i] = perspective_view(position, forward, up, 1.0, near, far, size, margin);
  }
  return views;
}

std::vector<double> cascade_splits(double near, double far, int count, double weight) {
  std::vector<double> splits;
  const float ratio = static_cast<float>(far / near);
  for (int i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    const double geometric = near * static_cast<double>(pow(ratio, static_cast<float>(share)));
    splits.push_back(weight * geometric + (1.0 - weight) * (near + (far - near) * share));
  }
  return splits;
}

}  // namespace halfspace::HS_LANES
