// SPDX-License-Identifier: Apache-2.0
//
// Reference implementation of the opaque pipeline as a plain loop, in the order used by the OpenGL specification. For each triangle: shade
// three vertices, clip, divide by w, visit every pixel of the bounding box, interpolate, shade, test depth.
//
// With R = float, this is a slow but readable equivalent of the tile-based pipeline. With R = double, it is the accuracy reference: vertex
// positions, interpolation, texture filtering and shading use double precision. Coverage is computed on the same 1/256 px grid.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/pipeline/window.h"
#include "halfspace/raster/vertex_input.h"
#include "halfspace/raster/visibility/depth_stencil_test.h"
#include "halfspace/shading/contract.h"

namespace halfspace {

/// Render target of the naive pipeline: linear color and window depth, top row first.
template <class R>
struct NaiveTarget {
  Image<vec4<R>> color;
  Image<R> depth;
  NaiveTarget(int width, int height, vec4<R> clear_color, R clear_depth) : color(width, height), depth(width, height) {
    std::fill_n(color.data(), width * height, clear_color);
    std::fill_n(depth.data(), width * height, clear_depth);
  }
};

namespace naive {

template <class R, class V>
struct Vertex {
  vec4<R> pos_clip;
  V varyings;
};

// Step 1: fetch the attributes from the vertex streams and run the vertex function.
template <class A, class R>
A attributes_of(const VertexView& view, std::size_t index) {
  std::array<R, kComponents<A>> in{};
  std::size_t c = 0;
  for (int s = 0; s < view.stream_count; ++s) {
    const VertexStream& stream = view.streams[static_cast<std::size_t>(s)];
    for (int k = 0; k < stream.components; ++k)
      in[c++] = static_cast<R>(stream.data[index * static_cast<std::size_t>(stream.stride) + static_cast<std::size_t>(k)]);
  }
  return from_components<A, R>(in);
}
template <class R, class S, class V = typename S::template Varyings<R>>
Vertex<R, V> shade_vertex(const S& shader, const VertexView& view, std::size_t index) {
  Vertex<R, V> v{};
  const auto in = attributes_of<typename S::template Attributes<R>, R>(view, index);
  v.pos_clip = call_vertex<S, R>(shader, in, {static_cast<int32_t>(index), 0}, v.varyings);
  return v;
}

template <class R, class V>
Vertex<R, V> mix(const Vertex<R, V>& a, const Vertex<R, V>& b, R t) {
  auto x = to_components<R>(a.varyings);
  const auto y = to_components<R>(b.varyings);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += t * (y[i] - x[i]);
  return {a.pos_clip + (b.pos_clip - a.pos_clip) * t, from_components<V, R>(x)};
}

// Step 2: clip a convex polygon against the plane distance(pos_clip) = 0, keeping the side where distance >= 0.
template <class R, class V, class Distance>
std::vector<Vertex<R, V>> clip(const std::vector<Vertex<R, V>>& polygon, Distance distance) {
  std::vector<Vertex<R, V>> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const R da = distance(a.pos_clip), db = distance(b.pos_clip);
    if (da >= 0) kept.push_back(a);
    if (da >= 0 && db < 0) kept.push_back(mix(a, b, da / (da - db)));
    if (da < 0 && db >= 0) kept.push_back(mix(b, a, db / (db - da)));
  }
  return kept;
}

// Step 3: divide by w and transform to window coordinates. Positions are snapped to the 1/256 px grid.
template <class R>
struct ScreenPoint {
  int64_t x, y;
  R z, inv_w;
};
template <class R>
ScreenPoint<R> to_window(const vec4<R>& p, const Rect& viewport, const DepthState& depth) {
  const R inv_w = R(1) / p.w;
  const auto snap = [&](R ndc, int origin, int size) {
    const R px = (ndc + R(1)) / R(2) * R(static_cast<float>(size)) + R(static_cast<float>(origin));
    return static_cast<int64_t>(std::nearbyint(std::clamp(static_cast<double>(px) * 256.0, -0x1p30, 0x1p30)));
  };
  const R ndc = p.z * inv_w;
  const R unit = depth.clip == ClipDepth::negative_one_to_one ? (ndc + R(1)) / R(2) : ndc;
  const R z = R(depth.range_near) + unit * (R(depth.range_far) - R(depth.range_near));
  return {snap(p.x * inv_w, viewport.x, viewport.width), snap(p.y * inv_w, viewport.y, viewport.height), z, inv_w};
}

// Step 4: visit every pixel whose center is inside the triangle, or on an edge whose samples belong to it.
template <class F>
void for_each_covered(std::array<std::array<int64_t, 2>, 3> p, const Rect& bounds, F pixel) {
  const auto edge = [&](std::size_t a, std::size_t b, int64_t x, int64_t y) {
    const int64_t ex = p[b][0] - p[a][0], ey = p[b][1] - p[a][1];
    const int64_t e = ex * (y - p[a][1]) - ey * (x - p[a][0]);
    const bool owned = ey < 0 || (ey == 0 && ex > 0);
    return e > 0 || (e == 0 && owned);
  };
  const auto [x_low, x_high] = std::minmax({p[0][0], p[1][0], p[2][0]});
  const auto [y_low, y_high] = std::minmax({p[0][1], p[1][1], p[2][1]});
  const int64_t x1 = std::min<int64_t>(bounds.x + bounds.width - 1, x_high >> 8),
                y1 = std::min<int64_t>(bounds.y + bounds.height - 1, y_high >> 8);
  for (int64_t y = std::max<int64_t>(bounds.y, y_low >> 8); y <= y1; ++y) {
    for (int64_t x = std::max<int64_t>(bounds.x, x_low >> 8); x <= x1; ++x) {
      const int64_t sx = x * 256 + 128, sy = y * 256 + 128;
      if (edge(0, 1, sx, sy) && edge(1, 2, sx, sy) && edge(2, 0, sx, sy)) pixel(static_cast<int>(x), static_cast<int>(y));
    }
  }
}

// Step 5: interpolate, shade and depth-test the pixels of one triangle. See shading/pixel.h for the formulas.
template <class R, class S, class V>
void rasterize(NaiveTarget<R>& target, const S& shader, const std::array<const Vertex<R, V>*, 3>& in, const PrimitiveOf<S, R>& face,
               const std::array<ScreenPoint<R>, 3>& p, const Rect& bounds, const DrawState& state, const V& provoking) {
  const int64_t area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  if (area == 0) return;
  const bool front = (area > 0) == (state.front == Winding::counter_clockwise);
  if (is_culled(state.cull, front)) return;
  std::array<std::size_t, 3> o{0, 1, 2};  // counter-clockwise, smallest 1/w first
  if (area < 0) std::swap(o[1], o[2]);
  while (p[o[0]].inv_w > std::min(p[o[1]].inv_w, p[o[2]].inv_w)) std::rotate(o.begin(), o.begin() + 1, o.end());
  const ScreenPoint<R>&a = p[o[0]], &b = p[o[1]], &c = p[o[2]];
  const auto real = [](int64_t i) { return static_cast<R>(i); };
  const TriangleLanes<R> t{
      real(a.x), real(a.y), real(b.x - a.x), real(b.y - a.y), real(c.x - a.x), real(c.y - a.y), real(std::abs(area)), a.inv_w, b.inv_w,
      c.inv_w,   R(1)};
  ComponentLanes<R, kComponents<V>> lanes;
  const auto v0 = to_components<R>(in[o[0]]->varyings), v1 = to_components<R>(in[o[1]]->varyings),
             v2 = to_components<R>(in[o[2]]->varyings);
  for (std::size_t i = 0; i < kComponents<V>; ++i) {
    const bool flat = kInterpolations<V>[i] == Interpolation::flat;
    lanes.value0[i] = flat ? to_components<R>(provoking)[i] : v0[i];
    lanes.delta1[i] = v1[i] - v0[i];
    lanes.delta2[i] = v2[i] - v0[i];
  }
  for_each_covered({{{a.x, a.y}, {b.x, b.y}, {c.x, c.y}}}, bounds, [&](int x, int y) {
    Pixel<R> px;
    px.triangle = &t;
    px.component_lanes = &lanes;
    px.dx = real(x * 256 + 128 - a.x);
    px.dy = real(y * 256 + 128 - a.y);
    px.weights = weights_at(t, px.dx, px.dy);
    px.x = real(x) + R(0.5f);
    px.y = real(y) + R(0.5f);
    px.quad_x = real(x & 1);
    px.quad_y = real(y & 1);
    R z = std::clamp(a.z + px.weights.b1 * (b.z - a.z) + px.weights.b2 * (c.z - a.z), R(0), R(1));
    px.find_z = [](const Pixel<R>& pixel) { return *static_cast<const R*>(pixel.z_source); };
    px.z_source = &z;
    px.front_facing = front;
    const auto fragment =
        call_fragment<S, R>(shader, interpolate_all<V>(px.weights, lanes, std::make_index_sequence<kComponents<V>>()), face, px);
    if constexpr (kDiscards<S>)
      if (!fragment.keep) return;
    if constexpr (kWritesDepth<S>) z = fragment.depth;
    const int row = target.depth.height() - 1 - y;
    if (state.depth.test && !compare(state.depth.compare, z, target.depth.at(x, row))) return;
    if (state.depth.test && state.depth.write) target.depth.at(x, row) = z;
    target.color.at(x, row) = fragment.color;
  });
}

}  // namespace naive

/// Draws an indexed triangle list. The vertex function must return a vec4<R>, and the fragment function must return a single color.
///
/// Only these parts of the state are used: viewport, scissor, cull, front, provoking, and depth except for clamp. In particular, there is
/// no blending, no stencil test, no polygon offset and no instancing.
template <class R, Shader S>
void draw_naive(NaiveTarget<R>& target, const S& shader, const VertexView& vertices, const Indices& indices, const DrawState& state = {}) {
  static_assert(!kUsesPrimitiveId<S>, "draw_naive() does not know the ids of primitives");
  using V = typename S::template Varyings<R>;
  const Rect viewport = state.viewport.value_or(Rect{0, 0, target.color.width(), target.color.height()});
  Rect bounds = intersect({0, 0, target.color.width(), target.color.height()}, viewport);
  if (state.scissor) bounds = intersect(bounds, *state.scissor);
  const R near_w = state.depth.clip == ClipDepth::negative_one_to_one ? R(1) : R(0);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    std::vector<naive::Vertex<R, V>> polygon;
    for (std::size_t k = 0; k < 3; ++k) polygon.push_back(naive::shade_vertex<R>(shader, vertices, indices[i + k]));
    const auto whole = polygon;
    const V& provoking = whole[state.provoking == ProvokingVertex::first ? 0 : 2].varyings;
    PrimitiveOf<S, R> face{};
    if constexpr (HasPrimitive<S>) face = shader.primitive(whole[0].varyings, whole[1].varyings, whole[2].varyings);
    polygon = naive::clip(polygon, [](const vec4<R>& p) { return p.w - R(kMinW); });
    polygon = naive::clip(polygon, [&](const vec4<R>& p) { return p.z + near_w * p.w; });
    polygon = naive::clip(polygon, [](const vec4<R>& p) { return p.w - p.z; });
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      std::array<const naive::Vertex<R, V>*, 3> v{&polygon[0], &polygon[k - 1], &polygon[k]};
      std::array<naive::ScreenPoint<R>, 3> p;
      for (std::size_t j = 0; j < 3; ++j) p[j] = naive::to_window(v[j]->pos_clip, viewport, state.depth);
      naive::rasterize(target, shader, v, face, p, bounds, state, provoking);
    }
  }
}

}  // namespace halfspace
