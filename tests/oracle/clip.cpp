// SPDX-License-Identifier: Apache-2.0
#include "oracle/clip.h"

#include <cmath>
#include <cstdint>
#include <optional>

namespace halfspace::oracle {

namespace {

// A point is inside if a·x + b·y + c·z + d·w + k ≥ 0.
struct Plane {
  double a, b, c, d, k;
  std::optional<std::array<double, 3>> by_vertex{};  // for a clip distance: the values at the vertices of the triangle

  double operator()(const ClipPoint& q) const {
    if (!by_vertex) return a * q.p[0] + b * q.p[1] + c * q.p[2] + d * q.p[3] + k;
    if (q.vertex >= 0) return (*by_vertex)[static_cast<std::size_t>(q.vertex)];
    return q.weight[0] * (*by_vertex)[0] + q.weight[1] * (*by_vertex)[1] + q.weight[2] * (*by_vertex)[2];
  }
};

// Returns the planes in clipping order.
std::vector<Plane> clip_planes(const Transform& t, const DepthState& state) {
  std::vector<Plane> planes{{0, 0, 0, 1, -static_cast<double>(kMinW)}};
  if (!state.clamp) {
    planes.push_back(state.clip == ClipDepth::zero_to_one ? Plane{0, 0, 1, 0, 0} : Plane{0, 0, 1, 1, 0});
    planes.push_back({0, 0, -1, 1, 0});
  }
  planes.push_back({1, 0, 0, -static_cast<double>(t.left), 0});
  planes.push_back({-1, 0, 0, static_cast<double>(t.right), 0});
  planes.push_back({0, 1, 0, -static_cast<double>(t.bottom), 0});
  planes.push_back({0, -1, 0, static_cast<double>(t.top), 0});
  return planes;
}

// Returns (a·p − b·q) / (a − b) for all members of p and q.
ClipPoint mix(double a, const ClipPoint& p, double b, const ClipPoint& q) {
  ClipPoint r{};
  for (std::size_t i = 0; i < 4; ++i) r.p[i] = (a * p.p[i] - b * q.p[i]) / (a - b);
  for (std::size_t i = 0; i < 3; ++i) r.weight[i] = (a * p.weight[i] - b * q.weight[i]) / (a - b);
  r.vertex = -1;
  return r;
}

// Returns the intersection of the plane with the edge from an inside point to an outside point.
ClipPoint meet(const Plane& plane, const ClipPoint& in, const ClipPoint& out) { return mix(plane(in), out, plane(out), in); }

// Returns the intersection of the edge with w = kMinW: first intersects the edge with w = 0, and then moves back along it.
ClipPoint meet_least_w(const ClipPoint& in, const ClipPoint& out) {
  ClipPoint r = mix(in.p[3], out, out.p[3], in);
  const double back = static_cast<double>(kMinW) / (in.p[3] - out.p[3]);
  for (std::size_t i = 0; i < 3; ++i) r.p[i] += back * (in.p[i] - out.p[i]);
  for (std::size_t i = 0; i < 3; ++i) r.weight[i] += back * (in.weight[i] - out.weight[i]);
  r.p[3] = static_cast<double>(kMinW);
  return r;
}

Polygon cut(const Plane& plane, bool is_least_w, const Polygon& polygon) {
  const auto cut_edge = [&](const ClipPoint& in, const ClipPoint& out) {
    return is_least_w ? meet_least_w(in, out) : meet(plane, in, out);
  };
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipPoint& here = polygon[i];
    const ClipPoint& next = polygon[(i + 1) % polygon.size()];
    const bool here_inside = plane(here) >= 0, next_inside = plane(next) >= 0;
    if (here_inside) kept.push_back(here);
    if (here_inside && !next_inside) kept.push_back(cut_edge(here, next));
    if (!here_inside && next_inside) kept.push_back(cut_edge(next, here));
  }
  return kept;
}

// Returns the part of a line that is inside the plane: two points or none.
Polygon cut_line(const Plane& plane, bool is_least_w, const Polygon& line) {
  if (line.empty()) return {};
  const bool in0 = plane(line[0]) >= 0, in1 = plane(line[1]) >= 0;
  const auto meeting = [&](const ClipPoint& in, const ClipPoint& out) { return is_least_w ? meet_least_w(in, out) : meet(plane, in, out); };
  if (!in0 && !in1) return {};
  return {in0 ? line[0] : meeting(line[1], line[0]), in1 ? line[1] : meeting(line[0], line[1])};
}

int64_t snap_corner(double ndc, float half, float center) {
  return std::llrint((ndc * static_cast<double>(half) + static_cast<double>(center)) * 256.0);
}

}  // namespace

Polygon clip_primitive(const Transform& t, const DepthState& state, const std::array<const ShadedVertex*, 3>& v, bool is_line) {
  Polygon polygon;
  for (std::size_t i = 0; i < (is_line ? 2 : 3); ++i) {
    const glm::vec4& p = v[i]->pos_clip;
    polygon.push_back({{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z), static_cast<double>(p.w)},
                       {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0},
                       static_cast<int>(i)});
  }
  std::vector<Plane> planes = clip_planes(t, state);
  for (std::size_t k = 0; k < v[0]->clip_distances.size(); ++k) {
    const auto of = [&](std::size_t i) { return static_cast<double>(v[i]->clip_distances[k]); };
    planes.push_back({0, 0, 0, 0, 0, std::array{of(0), of(1), of(2)}});
  }
  for (const Plane& plane : planes) {
    polygon = is_line ? cut_line(plane, &plane == planes.data(), polygon) : cut(plane, &plane == planes.data(), polygon);
  }
  return polygon;
}

Corner clip_corner(const Transform& t, const ClipPoint& c, const std::array<const ShadedVertex*, 3>& v, const ShaderFacts& facts,
                   std::size_t provoking) {
  Corner r;
  const double inverse = 1.0 / c.p[3];
  r.x = snap_corner(c.p[0] * inverse, t.half_width, t.center_x);
  r.y = snap_corner(c.p[1] * inverse, t.half_height, t.center_y);
  const double z = c.p[2] * inverse * static_cast<double>(t.z_scale) + static_cast<double>(t.z_bias);
  r.z = static_cast<float>(std::fmin(std::fmax(z, -1e30), 1e30));
  r.inv_w = static_cast<float>(inverse);
  if (c.vertex >= 0) r = project(t, *v[static_cast<std::size_t>(c.vertex)]);
  r.varyings.resize(facts.interpolations.size());
  for (std::size_t i = 0; i < r.varyings.size(); ++i) {
    std::array<double, 3> weight = c.weight;
    if (facts.interpolations[i] == Interpolation::linear) {  // linear in the window: weights are proportional to w
      for (std::size_t k = 0; k < 3; ++k) weight[k] = c.weight[k] * static_cast<double>(v[k]->pos_clip.w) / c.p[3];
    }
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += weight[k] * static_cast<double>(v[k]->varyings[i]);
    r.varyings[i] = facts.interpolations[i] == Interpolation::flat ? v[provoking]->varyings[i] : static_cast<float>(sum);
  }
  return r;
}

}  // namespace halfspace::oracle
