// SPDX-License-Identifier: Apache-2.0
//
// Reference implementation of the opaque pipeline as a plain loop, in the order used by the OpenGL specification. For each triangle: shade
// three vertices, clip, divide by w, visit every pixel of the bounding box, interpolate, shade, test depth. If the shader has tessellation,
// a patch is divided into triangles after its vertices are shaded; if it has a geometry function, it replaces each triangle with those that
// it emits.
//
// With R = float, this is a slow but readable equivalent of the tile-based pipeline: it calls the same formulas for snapping, clipping,
// depth and interpolation, and its output is bit-identical. With R = double, it is the accuracy reference: vertex positions, interpolation,
// texture filtering and shading use double precision. Coverage is computed on the same 1/256 px grid, and patches are divided in the same
// way, for levels that are rounded to float.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "halfspace/core/float_mode.h"
#include "halfspace/core/image.h"
#include "halfspace/raster/detail/draw_input.h"
#include "halfspace/raster/detail/draw_placement.h"
#include "halfspace/raster/detail/naive_stages.h"
#include "halfspace/raster/detail/naive_steps.h"
#include "halfspace/raster/detail/stream_match.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/shade/plane_anchor.h"
#include "halfspace/raster/vertex_input.h"
#include "halfspace/raster/visibility/tests/depth_stencil_test.h"
#include "halfspace/shading/shader_traits.h"

namespace halfspace::HS_LANES {

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

// Step 1: fetch the attributes from the vertex streams and run the vertex function.
template <class A, class R>
A attributes_of(const VertexView& view, std::size_t index) {
  std::array<float, kComponents<A>> row{};
  read_vertex(view.used_streams(), index, row);
  std::array<R, kComponents<A>> in{};
  for (std::size_t i = 0; i < in.size(); ++i) {
    const bool converts = !kIsFloat<R> && (view.integer_components >> i & 1) != 0;  // see shading/varyings.h
    in[i] = converts ? static_cast<R>(as_int(row[i])) : static_cast<R>(row[i]);
  }
  return from_components<A, R>(in);
}
template <class R, class S, class V = VertexVaryingsOf<S, R>>
Vertex<R, V> shade_vertex(const S& shader, const VertexView& view, std::size_t index) {
  V varyings{};
  const auto in = attributes_of<typename S::template Attributes<R>, R>(view, index);
  const auto result = call_vertex<S, R>(shader, in, {static_cast<int32_t>(index), 0}, varyings);
  return vertex_of<R>(result, varyings);
}

// Steps 2 and 3, tessellation and the geometry function, are in detail/naive_stages.h.
// Steps 4 and 5, clipping and the transform to window coordinates, are in detail/naive_steps.h.

// Step 6: visit every pixel whose center is inside the triangle, or on an edge that owns its samples under the fill rule.
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

// The input of interpolation.
template <class R, class V>
struct Surface {
  TriangleLanes<R> lanes;
  ComponentLanes<R, kComponents<V>> components;
};
// Replaces the barycentric weights with planes if the triangle is given as planes in the cell (raster/shade/plane_anchor.h).
template <class V>
void use_planes(const std::array<ScreenPoint<float>, 3>& p, const std::array<std::array<float, kComponents<V>>, 3>& values,
                const PlaneCell& cell, Surface<float, V>& s) {
  const auto corner = [&](std::size_t i) { return PlaneCorner{p[i].x, p[i].y, p[i].inv_w}; };
  const PlaneAnchor anchor = plane_anchor({corner(0), corner(1), corner(2)}, cell);
  if (!anchor.is_valid) return;
  s.lanes = {static_cast<float>(anchor.x), static_cast<float>(anchor.y), 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, p[0].inv_w, 0.0f, 0.0f, 1.0f, true};
  for (std::size_t i = 0; i < kComponents<V>; ++i) {
    if (kInterpolations<V>[i] == Interpolation::flat) continue;
    const std::array<float, 3> plane = anchor.plane(values[0][i], values[1][i], values[2][i]);
    s.components.value0[i] = plane[0];
    s.components.delta1[i] = plane[1];
    s.components.delta2[i] = plane[2];
  }
}

// Step 7: interpolate, shade and depth-test the pixels of one triangle. See shading/pixel.h for the formulas.
template <class R, class S, class V>
void rasterize(NaiveTarget<R>& target, const S& shader, const std::array<const Vertex<R, V>*, 3>& in, const PrimitiveOf<S, R>& face,
               const std::array<ScreenPoint<R>, 3>& p, const Rect& bounds, const DrawState& state, const V& provoking) {
  const int64_t area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  if (area == 0) return;
  const bool front = is_front(state, area > 0);
  if (is_culled(state.cull, front)) return;
  std::array<std::size_t, 3> o{0, 1, 2};  // counter-clockwise, smallest depth first
  if (area < 0) std::swap(o[1], o[2]);
  while (p[o[0]].z > std::min(p[o[1]].z, p[o[2]].z)) std::rotate(o.begin(), o.begin() + 1, o.end());
  const NaiveDepthPlane<R> depth_plane({p[o[0]], p[o[1]], p[o[2]]}, state.offset);
  while (p[o[0]].inv_w > std::min(p[o[1]].inv_w, p[o[2]].inv_w)) std::rotate(o.begin(), o.begin() + 1, o.end());  // smallest 1/w first
  const ScreenPoint<R>&a = p[o[0]], &b = p[o[1]], &c = p[o[2]];
  const auto real = [](int64_t i) { return static_cast<R>(i); };
  Surface<R, V> whole;
  whole.lanes = {real(a.x), real(a.y), real(b.x - a.x), real(b.y - a.y), real(c.x - a.x), real(c.y - a.y), R(0), a.inv_w, b.inv_w,
                 c.inv_w,   R(1)};
  whole.lanes.area = difference_of_products(whole.lanes.e1x, whole.lanes.e2y, whole.lanes.e1y, whole.lanes.e2x);
  const std::array<std::array<R, kComponents<V>>, 3> values{to_components<R>(in[o[0]]->varyings), to_components<R>(in[o[1]]->varyings),
                                                            to_components<R>(in[o[2]]->varyings)};
  for (std::size_t i = 0; i < kComponents<V>; ++i) {
    const bool flat = kInterpolations<V>[i] == Interpolation::flat;
    whole.components.value0[i] = flat ? to_components<R>(provoking)[i] : values[0][i];
    whole.components.delta1[i] = values[1][i] - values[0][i];
    whole.components.delta2[i] = values[2][i] - values[0][i];
  }
  std::optional<PlaneCell> cell;
  Surface<R, V> surface = whole;
  for_each_covered({{{a.x, a.y}, {b.x, b.y}, {c.x, c.y}}}, bounds, [&](int x, int y) {
    if constexpr (kIsFloat<R>) {
      if (cell != PlaneCell::of(x, y)) {
        cell = PlaneCell::of(x, y);
        surface = whole;
        use_planes<V>({a, b, c}, values, *cell, surface);
      }
    }
    Pixel<R> px;
    place_pixel<V>(px, surface.lanes, surface.components, real(x * 256 + 128), real(y * 256 + 128), real(x & 1), real(y & 1));
    R z = std::clamp(depth_plane.at(x * 256 + 128, y * 256 + 128), R(std::min(state.depth.range_near, state.depth.range_far)),
                     R(std::max(state.depth.range_near, state.depth.range_far)));
    px.find_z = [](const Pixel<R>& pixel) { return *static_cast<const R*>(pixel.z_source); };
    px.z_source = &z;
    px.front_facing = front;
    const auto fragment = call_fragment<S, R>(
        shader, interpolate_all<V>(px.weights, surface.components, std::make_index_sequence<kComponents<V>>()), face, px);
    bool keep = true;
    if constexpr (kDiscards<S>) keep = fragment.keep;
    if (!keep && !kTestsEarly<S>) return;
    if constexpr (kWritesDepth<S>) {
      const R of_triangle = z;
      z = fragment.depth;
      if (kConservativeDepth<S> == ConservativeDepth::greater) z = std::max(z, of_triangle);
      if (kConservativeDepth<S> == ConservativeDepth::less) z = std::min(z, of_triangle);
    }
    const int row = target.depth.height() - 1 - y;
    R& stored = target.depth.at(x, row);
    if (state.depth_bounds && (stored < R(state.depth_bounds->low) || stored > R(state.depth_bounds->high))) return;
    if (state.depth.test && !compare(state.depth.compare, z, stored)) return;
    if (state.depth.test && state.depth.write) stored = z;
    if (keep) target.color.at(x, row) = fragment.color;
  });
}

}  // namespace naive

/// Draws an indexed list of triangles or, if the shader has tessellation, of patches, for any DrawState::topology. An incomplete primitive
/// at the end is not drawn.
///
/// The shader can have clip and cull distances, tessellation into triangles (TessellationDomain::triangles or quads, without point_mode),
/// and a geometry function that receives triangles and emits triangle strips. The fragment function must return a single color. Shaders
/// with other layouts, and those that give vertices a layer or the bounds of a point, or read primitive IDs, do not compile. Point sizes
/// are ignored.
///
/// Only these parts of the state are used: first, count, base_vertex, viewport, clip_origin, scissor, cull, front, provoking, depth, offset
/// of filled triangles (in the unit of depths that are floats) and depth_bounds; in double, depth.clamp is ignored. There is no
/// blending, no stencil test, no smooth primitives, no instancing and no primitive restart. In the source tree, tests/oracle is a plain
/// scalar renderer that has all of these, in float.
template <class R, Shader S>
void draw_naive(NaiveTarget<R>& target, const S& shader, const VertexView& vertices, const Indices& indices, const DrawState& state = {}) {
  const FloatMode float_mode;
  static_assert(require_shader<S>());
  static_assert(!kUsesPrimitiveId<S>, "draw_naive() does not support primitive ids");
  static_assert(!kGivesLayer<S> && !kGivesPointSprite<S>, "draw_naive() supports neither layers of vertices nor bounds of points");
  static_assert(naive::divides_into_triangles<S>(), "draw_naive() supports only tessellation into triangles, not into lines or points");
  static_assert(naive::emits_triangles<S>(), "draw_naive() supports only geometry functions from triangles to triangle strips");
  constexpr std::size_t corners = naive::vertices_per_primitive<S>();
  using V = typename S::template Varyings<R>;
  const std::shared_ptr<const Indices> list = detail::view_indices(indices, vertices.vertex_count, state);
  HS_CHECK(!vertices.has_instance_streams, "draw_naive: a stream has one row per instance; expected one row per vertex in all streams");
  HS_CHECK(list->restarts().empty(), "draw_naive: the indices contain restarts; expected a list without them");
  detail::check_vertices(vertices, *list, state);
  detail::check_streams<typename S::template Attributes<float>>(vertices);
  HS_CHECK_OP(target.depth.width(), ==, target.color.width(),
              "draw_naive: the depths have another width than the colors; expected images of one size");
  HS_CHECK_OP(target.depth.height(), ==, target.color.height(),
              "draw_naive: the depths have another height than the colors; expected images of one size");
  const ViewportRect rect = detail::rounded_viewport(state.viewport, target.color.width(), target.color.height());
  const Viewport viewport = make_viewport(rect, state.depth, state.clip_origin);
  const Rect bounds = detail::drawable_rect(rect, state.scissor, target.color.width(), target.color.height(), SampleSpan{});
  const std::size_t provoking = state.provoking == ProvokingVertex::first ? 0 : 2;
  const auto vertex_at = [&](std::size_t i) { return static_cast<std::size_t>(int64_t{(*list)[i]} + state.base_vertex); };
  const auto draw_triangle = [&](const naive::TriangleOf<R, V>& whole) {
    PrimitiveOf<S, R> face{};
    if constexpr (HasPrimitive<S>) face = shader.primitive(whole[0].varyings, whole[1].varyings, whole[2].varyings);
    for (const naive::TriangleOf<R, V>& piece : naive::clipped(whole, viewport, state.depth, provoking)) {
      const std::array<naive::ScreenPoint<R>, 3> p{piece[0].window, piece[1].window, piece[2].window};
      naive::rasterize(target, shader, {&piece[0], &piece[1], &piece[2]}, face, p, bounds, state, whole[provoking].varyings);
    }
  };
  for (std::size_t i = 0; i < list->size() / corners; ++i) {
    const auto number = static_cast<int32_t>(i);
    std::array<naive::Vertex<R, VertexVaryingsOf<S, R>>, corners> primitive;
    for (std::size_t k = 0; k < corners; ++k) primitive[k] = naive::shade_vertex<R>(shader, vertices, vertex_at(i * corners + k));
    for (const auto& triangle : naive::divided<R>(shader, primitive, number)) {
      for (const naive::TriangleOf<R, V>& whole : naive::emitted<R>(shader, triangle, number, provoking == 0)) draw_triangle(whole);
    }
  }
}

}  // namespace halfspace::HS_LANES
