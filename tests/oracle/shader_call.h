// SPDX-License-Identifier: Apache-2.0
//
// Calls of the functions of a shader, for one vertex or one position. Input: its type and uniforms. Output: the structs of shader_data.h.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <vector>

#include "halfspace/raster/amplify/tessellator.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/shading/shader_traits.h"
#include "oracle/interpolation.h"
#include "oracle/shader_data.h"
#include "oracle/window.h"

namespace halfspace::oracle::detail {

inline void take_vertex(const glm::vec4& v, ShadedVertex& out) { out.pos_clip = v; }
template <std::size_t N, std::size_t M>
void take_vertex(const PerVertex<float, N, M>& v, ShadedVertex& out) {
  out.pos_clip = v.position;
  out.point_size = v.point_size;
  out.clip_distances.assign(v.clip_distance.begin(), v.clip_distance.end());
  out.cull_distances.assign(v.cull_distance.begin(), v.cull_distance.end());
}
template <std::size_t N, std::size_t M>
void take_vertex(const LayeredVertex<float, N, M>& v, ShadedVertex& out) {
  take_vertex(PerVertex<float, N, M>{v.position, v.point_size, v.clip_distance, v.cull_distance}, out);
  out.layer = v.layer;
  out.viewport = v.viewport;
}
inline void take_vertex(const PointSpriteVertex<float>& v, ShadedVertex& out) {
  out.pos_clip = {0.0f, 0.0f, v.depth, v.drawn ? 1.0f : -1.0f};
  out.has_bounds = true;
  out.low = v.low;
  out.high = v.high;
}

template <class T>
std::vector<float> components_of(const T& t) {
  const auto a = to_components<float>(t);
  return {a.begin(), a.end()};
}

template <class T>
T struct_of(const std::vector<float>& components) {
  std::array<float, kComponents<T>> a{};
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = components[i];
  return from_components<T, float>(a);
}

inline Topology topology_of(GeometryOutputPrimitive output) {
  if (output == GeometryOutputPrimitive::points) return Topology::points;
  return output == GeometryOutputPrimitive::line_strip ? Topology::line_strip : Topology::triangle_strip;
}

// Returns the strips that the geometry function emits for a primitive.
template <class S>
std::vector<std::vector<ShadedVertex>> call_geometry(const S& shader, const std::vector<const ShadedVertex*>& vertices, int32_t primitive,
                                                     int32_t instance, int32_t invocation, float point_size) {
  using In = GeometryInputOf<S, float>;
  using Out = EmitterOf<S, float>;
  In in{};
  for (std::size_t i = 0; i < in.position.size(); ++i) {
    in.position[i] = vec4<float>(vertices[i]->pos_clip);
    in.varyings[i] = struct_of<GeometryVaryingsOf<S, float>>(vertices[i]->varyings);
  }
  in.primitive = primitive;
  in.instance = instance;
  in.invocation = invocation;
  Out out(S::geometry_layout.max_vertices);
  shader.geometry(in, out);
  constexpr std::size_t n = kComponents<typename S::template Varyings<float>>, extra = Out::kRow - 4 - n;
  std::vector<std::vector<ShadedVertex>> strips;
  bool begins = true;
  for (int i = 0; i < out.count(0); ++i) {
    if (begins) strips.emplace_back();
    begins = out.ends_strip(0, i);
    const float* row = out.row(0, i);
    ShadedVertex v;
    v.pos_clip = {row[0], row[1], row[2], row[3]};
    v.point_size = extra == 0 ? point_size : row[4];
    if (extra != 0) {
      const float* const culls = row + 5 + kClipDistances<S>;
      v.clip_distances.assign(row + 5, culls);
      v.cull_distances.assign(culls, culls + kCullDistances<S>);
      if constexpr (kGivesLayer<S>) {
        v.layer = std::bit_cast<int32_t>(culls[kCullDistances<S>]);
        v.viewport = std::bit_cast<int32_t>(culls[kCullDistances<S> + 1]);
      }
    }
    v.varyings.assign(row + 4 + extra, row + Out::kRow);
    strips.back().push_back(v);
  }
  return strips;
}

// The vertices and primitives that a patch is divided into.
struct DividedPatch {
  std::vector<ShadedVertex> vertices;
  std::vector<std::vector<uint32_t>> primitives;
};

template <class S>
DividedPatch divide_patch(const S& shader, const std::vector<const ShadedVertex*>& corners, int32_t number, int32_t instance,
                          float point_size) {
  constexpr TessellationLayout layout = S::tessellation_layout;
  PatchInputOf<S, float> in{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    in.position[i] = vec4<float>(corners[i]->pos_clip);
    in.varyings[i] = struct_of<VertexVaryingsOf<S, float>>(corners[i]->varyings);
  }
  in.patch = number;
  in.instance = instance;
  PatchOf<S, float> patch{};
  Tessellation divided;
  tessellate({layout.domain, layout.spacing, layout.clockwise, layout.point_mode}, call_control<S, float>(shader, in, patch), divided);
  DividedPatch out;
  for (const glm::vec3& at : divided.coordinates) {
    EvaluatedVaryingsOf<S, float> varyings{};
    ShadedVertex& v = out.vertices.emplace_back();
    v.point_size = point_size;
    take_vertex(call_evaluate<S, float>(shader, in, patch, vec3<float>(at), varyings), v);
    v.varyings = components_of(varyings);
  }
  const std::size_t size = layout.point_mode ? 1 : layout.domain == TessellationDomain::isolines ? 2 : 3;
  for (std::size_t i = 0; i < divided.indices.size(); i += size)
    out.primitives.emplace_back(divided.indices.begin() + static_cast<int>(i), divided.indices.begin() + static_cast<int>(i + size));
  return out;
}

template <class S>
FragmentResult call_shader(const S& shader, const PrimitiveOf<S, float>& face, const WindowTriangle& t, const Surface& s,
                           const DepthState& state, const Place& place) {
  const Point &at = place.at, &centroid = place.centroid;
  using V = typename S::template Varyings<float>;
  constexpr std::size_t n = kComponents<V>;
  const SurfacePoint p = surface_point(s, t, state, at), inside = surface_point(s, t, state, centroid);
  ComponentLanes<float, n> components{};
  std::array<float, n> values{};
  for (std::size_t i = 0; i < n; ++i) {
    components.value0[i] = s.value0[i];
    components.delta1[i] = s.delta1[i];
    components.delta2[i] = s.delta2[i];
    const Interpolation mode = kInterpolations<V>[i];
    values[i] = component_at(s, mode == Interpolation::centroid ? inside : p, mode, i);
  }
  Pixel<float> px;
  px.x = static_cast<float>(at.x) / 256.0f;
  px.y = static_cast<float>(at.y) / 256.0f;
  struct Source {
    float z;
    int32_t mask;
  } const source{p.z, static_cast<int32_t>(place.mask)};
  px.find_z = [](const Pixel<float>& pixel) { return static_cast<const Source*>(pixel.z_source)->z; };
  px.find_sample_mask = [](const Pixel<float>& pixel) { return static_cast<const Source*>(pixel.z_source)->mask; };
  px.z_source = &source;
  px.sample = place.sample;
  px.samples = place.samples;
  px.front_facing = t.front;
  px.triangle = &s.lanes;
  px.component_lanes = &components;
  px.weights = p.weights;
  px.dx = p.dx;
  px.dy = p.dy;
  px.quad_x = static_cast<float>(at.x / 256 % 2);
  px.quad_y = static_cast<float>(at.y / 256 % 2);
  FragmentResult result;
  if constexpr (HasFragmentFunction<S>) {
    const auto fragment = call_fragment<S, float>(shader, from_components<V, float>(values), face, px);
    for (std::size_t i = 0; i < kColors<S>; ++i) result.colors.push_back(halfspace::detail::nth_color(fragment.color, i));
    if constexpr (kDiscards<S>) result.keep = fragment.keep;
    if constexpr (kWritesDepth<S>) result.depth = fragment.depth;
    if constexpr (kWritesSampleMask<S>) result.sample_mask = static_cast<uint32_t>(fragment.sample_mask);
  }
  return result;
}

template <class S>
ShaderFacts facts_of() {
  ShaderFacts facts;
  facts.interpolations = kInterpolations<typename S::template Varyings<float>>;
  facts.has_fragment = HasFragmentFunction<S>;
  if constexpr (HasFragmentFunction<S>) {
    facts.writes_depth = kWritesDepth<S>;
    facts.tests_early = kTestsEarly<S>;
    facts.conservative_depth = kConservativeDepth<S>;
    facts.runs_per_sample = kRunsPerSample<S>;
  }
  return facts;
}

}  // namespace halfspace::oracle::detail
