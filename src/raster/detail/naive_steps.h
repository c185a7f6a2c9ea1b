// SPDX-License-Identifier: Apache-2.0
//
// Steps of the naive pipeline (naive.h) that have two versions: the float version uses the formulas of the tile-based pipeline, and the
// double version follows the specification, and also clips to 2^19 px around the viewport.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include "halfspace/raster/pipeline/window.h"
#include "halfspace/raster/primitives/clip.h"
#include "halfspace/raster/primitives/setup_scalar.h"
#include "halfspace/raster/primitives/vertex_stage.h"
#include "halfspace/shading/vertex_traits.h"

namespace halfspace::HS_LANES::naive {

template <class R>
inline constexpr bool kIsFloat = std::is_same_v<R, float>;

// Window coordinates; x and y in 1/256 px.
template <class R>
struct ScreenPoint {
  int64_t x, y;
  R z, inv_w;
};

inline constexpr std::size_t kDistances = kMaxDistances;  // clip distances of a vertex, and cull distances

template <class R, class V>
struct Vertex {
  vec4<R> pos_clip;
  V varyings;
  ScreenPoint<R> window;                                       // after step 5
  std::array<R, kDistances> clip_distance{}, cull_distance{};  // 0 if the shader does not have them, which has no effect
};
template <class R, class V>
using TriangleOf = std::array<Vertex<R, V>, 3>;

// Returns a vertex with the values of a vertex or an evaluation function. result: what the function returns.
template <class R, class P, class V>
Vertex<R, V> vertex_of(const P& result, const V& varyings) {
  Vertex<R, V> v{position_of(result), varyings, {}};
  if constexpr (requires { result.clip_distance; }) {
    std::copy(result.clip_distance.begin(), result.clip_distance.end(), v.clip_distance.begin());
    std::copy(result.cull_distance.begin(), result.cull_distance.end(), v.cull_distance.begin());
  }
  return v;
}

// ---- step 4: cull distances and clipping ---------------------------------------------------------------------------

// Returns true if a cull distance is negative at all vertices, so that the triangle is not drawn.
template <class R, class V>
bool is_culled_by_distance(const TriangleOf<R, V>& t) {
  for (std::size_t k = 0; k < kDistances; ++k) {
    if (t[0].cull_distance[k] < R(0) && t[1].cull_distance[k] < R(0) && t[2].cull_distance[k] < R(0)) return true;
  }
  return false;
}

template <class R, class V>
Vertex<R, V> mix(const Vertex<R, V>& a, const Vertex<R, V>& b, R t) {
  auto x = to_components<R>(a.varyings);
  const auto y = to_components<R>(b.varyings);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += t * (y[i] - x[i]);
  Vertex<R, V> v{a.pos_clip + (b.pos_clip - a.pos_clip) * t, from_components<V, R>(x), {}};
  for (std::size_t k = 0; k < kDistances; ++k) v.clip_distance[k] = a.clip_distance[k] + t * (b.clip_distance[k] - a.clip_distance[k]);
  return v;
}

// Clips a convex polygon against the plane distance(vertex) = 0, keeping the side where distance >= 0.
template <class R, class V, class Distance>
std::vector<Vertex<R, V>> clip(std::vector<Vertex<R, V>> polygon, Distance distance) {
  if (std::all_of(polygon.begin(), polygon.end(), [&](const auto& v) { return distance(v) >= 0; })) return polygon;
  std::vector<Vertex<R, V>> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const R da = distance(a), db = distance(b);
    if (da >= 0) kept.push_back(a);
    if (da >= 0 && db < 0) kept.push_back(mix(a, b, da / (da - db)));
    if (da < 0 && db >= 0) kept.push_back(mix(b, a, db / (db - da)));
  }
  return kept;
}

// ---- step 5: divide by w and transform to window coordinates --------------------------------------------------------

// Positions are snapped to the 1/256 px grid.
template <class R>
ScreenPoint<R> to_window(const vec4<R>& p, const Viewport& v, const DepthState& depth) {
  if constexpr (kIsFloat<R>) {
    const WindowVertex<R> w = window_vertex<R>(v, depth, p.x, p.y, p.z, p.w);
    return {w.x, w.y, w.z, w.inv_w};
  } else {
    const R inv_w = R(1) / p.w;
    return {snap(static_cast<double>(p.x * inv_w), v.half_width, v.center_x),
            snap(static_cast<double>(p.y * inv_w), v.half_height, v.center_y), p.z * inv_w * R(v.depth_scale) + R(v.depth_bias), inv_w};
  }
}

// Clips a triangle and returns the remaining polygon, with window coordinates.
template <class V>
std::vector<Vertex<float, V>> clipped_polygon(const TriangleOf<float, V>& t, const Viewport& viewport, const DepthState& depth,
                                              std::size_t provoking) {
  std::array<glm::vec4, 3> pos_clip;
  std::array<std::array<float, kComponents<V>>, 3> rows;
  for (std::size_t k = 0; k < 3; ++k) {
    pos_clip[k] = glm::vec4(t[k].pos_clip.x, t[k].pos_clip.y, t[k].pos_clip.z, t[k].pos_clip.w);
    rows[k] = to_components<float>(t[k].varyings);
  }
  const ClipDistances distances{{t[0].clip_distance.data(), t[1].clip_distance.data(), t[2].clip_distance.data()},
                                static_cast<int>(kDistances)};
  const ClipPolygon polygon = clip_triangle(viewport, depth, pos_clip, distances);
  const std::array<double, 3> w{static_cast<double>(pos_clip[0].w), static_cast<double>(pos_clip[1].w), static_cast<double>(pos_clip[2].w)};
  std::vector<Vertex<float, V>> kept;
  for (int i = 0; i < polygon.count; ++i) {
    const ClipCorner& c = polygon.corners[static_cast<std::size_t>(i)];
    if (c.vertex >= 0) {
      kept.push_back(t[static_cast<std::size_t>(c.vertex)]);
      continue;
    }
    std::array<float, kComponents<V>> row;
    interpolate_corner(c, w, {rows[0].data(), rows[1].data(), rows[2].data()}, static_cast<int>(provoking), kInterpolations<V>, row.data());
    const ScreenVertex s = project_corner(viewport, c.pos_clip);
    kept.push_back({{}, from_components<V, float>(row), {s.x, s.y, s.z, s.inv_w}});
  }
  return kept;
}

// Largest distance of a vertex from the center of the viewport in double, in pixels.
inline constexpr double kReach = 0x1p19;

template <class R, class V>
std::vector<Vertex<R, V>> clipped_polygon(const TriangleOf<R, V>& t, const Viewport& viewport, const DepthState& depth, std::size_t) {
  const R near_w = depth.clip == ClipDepth::negative_one_to_one ? R(1) : R(0);
  std::vector<Vertex<R, V>> polygon(t.begin(), t.end());
  const auto clip_at = [&](auto distance) {
    polygon = clip(std::move(polygon), [&](const Vertex<R, V>& v) { return distance(v.pos_clip); });
  };
  clip_at([](const vec4<R>& p) { return p.w - R(kMinW); });
  clip_at([&](const vec4<R>& p) { return p.z + near_w * p.w; });
  clip_at([](const vec4<R>& p) { return p.w - p.z; });
  // Keeps window coordinates in the range of snap(), and products of their differences in the range of int64.
  const R reach_x = R(kReach) / R(viewport.half_width), reach_y = R(kReach) / R(std::fabs(viewport.half_height));
  clip_at([&](const vec4<R>& p) { return reach_x * p.w - p.x; });
  clip_at([&](const vec4<R>& p) { return reach_x * p.w + p.x; });
  clip_at([&](const vec4<R>& p) { return reach_y * p.w - p.y; });
  clip_at([&](const vec4<R>& p) { return reach_y * p.w + p.y; });
  for (std::size_t k = 0; k < kDistances; ++k)
    polygon = clip(std::move(polygon), [k](const Vertex<R, V>& v) { return v.clip_distance[k]; });
  for (Vertex<R, V>& v : polygon) v.window = to_window(v.pos_clip, viewport, depth);
  return polygon;
}

// Returns true if all distances are finite. A triangle with another one is not drawn.
template <class R, class V>
bool has_finite_distances(const Vertex<R, V>& v) {
  const auto is_finite = [](R x) { return std::isfinite(static_cast<double>(x)); };
  return std::all_of(v.clip_distance.begin(), v.clip_distance.end(), is_finite) &&
         std::all_of(v.cull_distance.begin(), v.cull_distance.end(), is_finite);
}

// Culls a triangle by its distances, clips it, and returns the remaining triangles as a fan, with window coordinates.
template <class R, class V>
std::vector<TriangleOf<R, V>> clipped(TriangleOf<R, V> t, const Viewport& viewport, const DepthState& depth, std::size_t provoking) {
  if (!std::all_of(t.begin(), t.end(), has_finite_distances<R, V>) || is_culled_by_distance<R, V>(t)) return {};
  Fan fan;
  std::vector<Vertex<R, V>> polygon;
  if constexpr (kIsFloat<R>) {
    Outcode any = 0, all = kOutView;
    bool is_cut = false;
    for (Vertex<R, V>& v : t) {
      const WindowVertex<R> w = window_vertex<R>(viewport, depth, v.pos_clip.x, v.pos_clip.y, v.pos_clip.z, v.pos_clip.w);
      v.window = {w.x, w.y, w.z, w.inv_w};
      any |= static_cast<Outcode>(w.outcode);
      all &= static_cast<Outcode>(w.outcode);
      for (const float distance : v.clip_distance) is_cut |= distance < 0.0f;
    }
    if ((any & kOutNonFinite) != 0 || all != 0) return {};
    if ((any & kOutNeedsClip) == 0 && !is_cut) return {t};
    polygon = clipped_polygon(t, viewport, depth, provoking);
    std::vector<ClipVertex> corners;
    for (const Vertex<R, V>& v : polygon)
      corners.push_back({{static_cast<int32_t>(v.window.x), static_cast<int32_t>(v.window.y), v.window.z, v.window.inv_w}, 0});
    fan = fan_of(corners.data(), static_cast<uint32_t>(corners.size()));
  } else {
    polygon = clipped_polygon(t, viewport, depth, provoking);
  }
  std::vector<TriangleOf<R, V>> pieces;
  const std::size_t n = polygon.size();
  for (std::size_t k = 2; k < n; ++k) {
    const TriangleOf<R, V> piece{polygon[fan.apex], polygon[(fan.apex + k - 1) % n], polygon[(fan.apex + k) % n]};
    const ScreenPoint<R>&a = piece[0].window, &b = piece[1].window, &c = piece[2].window;
    const int64_t area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (kIsFloat<R> && area != 0 && (area > 0) != fan.counter_clockwise) continue;  // a self-intersecting sliver; see fan_of
    pieces.push_back(piece);
  }
  return pieces;
}

// ---- step 7: depth -------------------------------------------------------------------------------------------------

// Polygon offset of a filled triangle, for depths that are floats.
template <class R>
float polygon_offset(const DepthOffset& offset, const std::array<ScreenPoint<R>, 3>& p) {
  if (!has_offset(offset, PolygonMode::fill)) return 0.0f;
  const auto real = [](R x) { return static_cast<float>(static_cast<double>(x)); };
  std::array<ScreenVertex, 3> v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = {static_cast<int32_t>(p[i].x), static_cast<int32_t>(p[i].y), real(p[i].z), real(p[i].inv_w)};
  return outline_offset(offset, DepthFormat::d32f, {&v[0], &v[1], &v[2]});
}

// Depth of a triangle at window positions in 1/256 px. The vertices are counter-clockwise, and the first one has the smallest depth.
template <class R>
class NaiveDepthPlane {
 public:
  NaiveDepthPlane(const std::array<ScreenPoint<R>, 3>& p, const DepthOffset& offset) : p_(p) {
    const double area = static_cast<double>((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x));
    z_edge1_ = static_cast<R>((static_cast<double>(p[1].z) - static_cast<double>(p[0].z)) / area);
    z_edge2_ = static_cast<R>((static_cast<double>(p[2].z) - static_cast<double>(p[0].z)) / area);
    const auto [x_low, x_high] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [y_low, y_high] = std::minmax({p[0].y, p[1].y, p[2].y});
    narrow_ = x_high - x_low <= kNarrowExtent && y_high - y_low <= kNarrowExtent;
    const auto by = static_cast<R>(polygon_offset(offset, p));
    p_[0].z += by;
    z_max_ = std::max({p[0].z, p[1].z, p[2].z}) + by;
  }

  R at(int64_t x, int64_t y) const {
    const int64_t dx = x - p_[0].x, dy = y - p_[0].y;
    const int64_t e1x = p_[1].x - p_[0].x, e1y = p_[1].y - p_[0].y, e2x = p_[2].x - p_[0].x, e2y = p_[2].y - p_[0].y;
    R w1 = static_cast<R>(dx * e2y - dy * e2x), w2 = static_cast<R>(e1x * dy - e1y * dx);
    if (kIsFloat<R> && !narrow_) {  // other triangles round the edge functions differently (visibility/coverage/depth_plane.h)
      w1 = difference_of_products(static_cast<R>(dx), static_cast<R>(e2y), static_cast<R>(dy), static_cast<R>(e2x));
      w2 = difference_of_products(static_cast<R>(e1x), static_cast<R>(dy), static_cast<R>(e1y), static_cast<R>(dx));
    }
    return std::clamp(fma(w1, z_edge1_, fma(w2, z_edge2_, p_[0].z)), p_[0].z, z_max_);
  }

 private:
  std::array<ScreenPoint<R>, 3> p_;
  R z_edge1_, z_edge2_, z_max_;
  bool narrow_;
};

}  // namespace halfspace::HS_LANES::naive
