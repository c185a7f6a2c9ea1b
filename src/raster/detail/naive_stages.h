// SPDX-License-Identifier: Apache-2.0
//
// The optional stages of the naive pipeline (naive.h) between the vertex function and clipping: tessellation and the geometry function.
// Each takes a primitive and returns the triangles that it becomes, in order. A shader without the stage passes its triangle on.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "halfspace/raster/amplify/tessellator.h"
#include "halfspace/raster/detail/naive_steps.h"
#include "halfspace/raster/primitives/primitive_assembly.h"
#include "halfspace/shading/vertex_traits.h"

namespace halfspace::HS_LANES::naive {

// Number of vertices of the primitives of a draw: patches if the shader has tessellation, otherwise triangles.
template <class S>
constexpr std::size_t vertices_per_primitive() {
  if constexpr (HasTessellationLayout<S>) {
    return static_cast<std::size_t>(S::tessellation_layout.patch_vertices);
  } else {
    return 3;
  }
}

// Whether patches, if the shader has any, are divided into triangles.
template <class S>
constexpr bool divides_into_triangles() {
  if constexpr (!HasTessellationLayout<S>) {
    return true;
  } else {
    return S::tessellation_layout.domain != TessellationDomain::isolines && !S::tessellation_layout.point_mode;
  }
}
// Whether the geometry function, if the shader has one, receives triangles and emits triangle strips.
template <class S>
constexpr bool emits_triangles() {
  if constexpr (!HasGeometryLayout<S>) {
    return true;
  } else {
    return S::geometry_layout.input == GeometryInputPrimitive::triangles &&
           S::geometry_layout.output == GeometryOutputPrimitive::triangle_strip;
  }
}

// Copies the positions and the varyings of a primitive to the input of a control, evaluation or geometry function.
template <class Primitive, class In>
void put_vertices(const Primitive& primitive, In& in) {
  for (std::size_t i = 0; i < primitive.size(); ++i) {
    in.position[i] = primitive[i].pos_clip;
    in.varyings[i] = primitive[i].varyings;
  }
}

// ---- step 2: tessellation ------------------------------------------------------------------------------------------

// Divides the domain of a patch. The tessellator computes in integers and takes levels as floats, for all R.
template <class S, class R>
Tessellation tessellate_domain(const TessellationLevels<R>& levels) {
  constexpr TessellationLayout layout = S::tessellation_layout;
  const auto to_float = [](R level) { return static_cast<float>(static_cast<double>(level)); };
  TessellationLevels<float> rounded;
  std::transform(levels.outer.begin(), levels.outer.end(), rounded.outer.begin(), to_float);
  std::transform(levels.inner.begin(), levels.inner.end(), rounded.inner.begin(), to_float);
  Tessellation domain;
  tessellate({layout.domain, layout.spacing, layout.clockwise, layout.point_mode}, rounded, domain);
  return domain;
}

// Runs the control function, the tessellator, and the evaluation function for each vertex. number: of the patch in the draw.
template <class R, class S, class Primitive>
std::vector<TriangleOf<R, GeometryVaryingsOf<S, R>>> divided(const S& shader, const Primitive& primitive, int32_t number) {
  if constexpr (!HasTessellationLayout<S>) {
    return {primitive};
  } else {
    using V = EvaluatedVaryingsOf<S, R>;
    PatchInputOf<S, R> in{};
    put_vertices(primitive, in);
    in.patch = number;
    PatchOf<S, R> patch{};
    const Tessellation domain = tessellate_domain<S>(call_control<S, R>(shader, in, patch));
    std::vector<Vertex<R, V>> vertices;
    for (const glm::vec3& at : domain.coordinates) {
      V varyings{};
      const auto result = call_evaluate<S, R>(shader, in, patch, vec3<R>(at), varyings);
      vertices.push_back(vertex_of<R>(result, varyings));
    }
    std::vector<TriangleOf<R, V>> triangles;
    for (std::size_t i = 0; i < domain.indices.size(); i += 3)
      triangles.push_back({vertices[domain.indices[i]], vertices[domain.indices[i + 1]], vertices[domain.indices[i + 2]]});
    return triangles;
  }
}

// ---- step 3: geometry function -------------------------------------------------------------------------------------

// Returns a vertex that a geometry function has emitted. Its row has the position, the point size and the distances if there are any, and
// the varyings.
template <class S, class R>
Vertex<R, typename S::template Varyings<R>> emitted_vertex(const EmitterOf<S, R>& emitter, int i) {
  using V = typename S::template Varyings<R>;
  const auto* const row = emitter.row(0, i);
  std::array<R, kComponents<V>> components;
  for (std::size_t k = 0; k < components.size(); ++k) components[k] = row[emitter.kRow - components.size() + k];
  Vertex<R, V> v{vec4<R>(row[0], row[1], row[2], row[3]), from_components<V, R>(components), {}};
  for (std::size_t k = 0; k < kClipDistances<S>; ++k) v.clip_distance[k] = row[5 + k];
  for (std::size_t k = 0; k < kCullDistances<S>; ++k) v.cull_distance[k] = row[5 + kClipDistances<S> + k];
  return v;
}

// Runs the geometry function for a triangle, and assembles the triangles of the strips that it emits. number: of the submitted primitive in
// the draw; first_provokes: see ProvokingVertex.
template <class R, class S>
std::vector<TriangleOf<R, typename S::template Varyings<R>>> emitted(const S& shader,
                                                                     const TriangleOf<R, GeometryVaryingsOf<S, R>>& triangle,
                                                                     int32_t number, bool first_provokes) {
  if constexpr (!HasGeometryLayout<S>) {
    return {triangle};
  } else {
    using V = typename S::template Varyings<R>;
    constexpr GeometryLayout layout = S::geometry_layout;
    GeometryInputOf<S, R> in{};
    put_vertices(triangle, in);
    in.primitive = number;
    EmitterOf<S, R> emitter(layout.max_vertices);
    std::vector<TriangleOf<R, V>> triangles;
    for (in.invocation = 0; in.invocation < layout.invocations; ++in.invocation) {
      emitter.clear();
      shader.geometry(in, emitter);
      std::vector<Vertex<R, V>> strip;
      for (int i = 0; i < emitter.count(0); ++i) {
        strip.push_back(emitted_vertex<S, R>(emitter, i));
        if (!emitter.ends_strip(0, i)) continue;
        for (uint32_t k = 0; k + 3 <= strip.size(); ++k) {
          const std::array<uint32_t, 3> at = strip_triangle(k, first_provokes);
          triangles.push_back({strip[at[0]], strip[at[1]], strip[at[2]]});
        }
        strip.clear();
      }
    }
    return triangles;
  }
}

}  // namespace halfspace::HS_LANES::naive
