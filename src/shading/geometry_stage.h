// SPDX-License-Identifier: Apache-2.0
//
// The geometry stage of a shader (OpenGL 4.6, section 11.3). It is optional. It runs once per primitive, after the vertex function and
// before clipping and culling, and emits points, line strips or triangle strips: none, one or several. A shader with a geometry stage has
//
//   static constexpr GeometryLayout geometry_layout{
//       .input = GeometryInputPrimitive::triangles, .output = GeometryOutputPrimitive::line_strip, .max_vertices = 6};
//   template <class R> void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const;
//
// Each lane of R is a primitive. To emit a vertex for some primitives only, pass a mask. The last lanes can repeat a primitive; what they
// emit is dropped.
//
// The following are optional:
//
//   template <class R> struct VertexVaryings { … };
//     What the vertex function passes to the geometry function, if it differs from what the geometry function passes to the fragment
//     function. GeometryInput then has VertexVaryings<R>, and Emitter has Varyings<R>.
//   template <class R> using EmittedVertex = PerVertex<R, N>;
//     The type of emitted vertices, to emit point sizes and N clip distances (and, as PerVertex<R, N, M>, M cull distances). The emitter is
//     then an Emitter<R, Varyings<R>, PerVertex<R, N>>. Point sizes, clip distances and layers that the vertex or the evaluation function
//     returns are not passed on. A LayeredVertex<R, N> also has a layer and a viewport.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "halfspace/shading/contract.h"
#include "halfspace/shading/varyings.h"

namespace halfspace::HS_LANES {

/// Primitives that a geometry function receives.
enum class GeometryInputPrimitive : uint8_t { points, lines, lines_adjacency, triangles, triangles_adjacency };
/// Primitives that a geometry function emits.
enum class GeometryOutputPrimitive : uint8_t { points, line_strip, triangle_strip };

/// Returns the number of vertices of a primitive, with adjacent vertices.
constexpr int vertices_of(GeometryInputPrimitive p) {
  switch (p) {
    case GeometryInputPrimitive::points: return 1;
    case GeometryInputPrimitive::lines: return 2;
    case GeometryInputPrimitive::lines_adjacency: return 4;
    case GeometryInputPrimitive::triangles: return 3;
    case GeometryInputPrimitive::triangles_adjacency: return 6;
  }
  return 0;
}

/// What a geometry function receives and emits (the layout qualifiers of GLSL).
struct GeometryLayout {
  GeometryInputPrimitive input = GeometryInputPrimitive::triangles;
  GeometryOutputPrimitive output = GeometryOutputPrimitive::triangle_strip;
  int max_vertices = 3;  ///< that an invocation emits, 1 to 256; further ones are ignored
  int invocations = 1;   ///< calls per primitive, 1 to 32; see GeometryInput::invocation
};
inline constexpr int kMaxGeometryVertices = 256;
inline constexpr int kMaxGeometryInvocations = 32;

/// A primitive with N vertices. Lines with adjacency have their end points at 1 and 2, and triangles with adjacency their corners at 0, 2
/// and 4; the other vertices are those of the neighbors (OpenGL 4.6, section 10.1).
template <class R, class V, std::size_t N>
struct GeometryInput {
  std::array<vec4<R>, N> position;  ///< as `vertex` returned it, usually in clip space
  std::array<V, N> varyings;
  IntOf<R> primitive;      ///< 0, 1, … in submission order; starts again in each instance (gl_PrimitiveIDIn)
  IntOf<R> instance;       ///< 0 … DrawState::instances − 1
  int32_t invocation = 0;  ///< 0 … GeometryLayout::invocations − 1
};

namespace detail {
/// Number of values of an emitted vertex between its position and its varyings: point size, clip and cull distances, layer and viewport.
template <class P>
inline constexpr std::size_t kExtraValues = 0;
template <class R, std::size_t N, std::size_t M>
inline constexpr std::size_t kExtraValues<PerVertex<R, N, M>> = 1 + N + M;
template <class R, std::size_t N, std::size_t M>
inline constexpr std::size_t kExtraValues<LayeredVertex<R, N, M>> = 3 + N + M;

template <class R, class Row>
HS_INLINE void put_vertex(const vec4<R>& v, Row& row) {
  for (int k = 0; k < 4; ++k) row[static_cast<std::size_t>(k)] = v[k];
}
template <class R, std::size_t N, std::size_t M, class Row>
HS_INLINE void put_vertex(const PerVertex<R, N, M>& v, Row& row) {
  put_vertex(v.position, row);
  row[4] = v.point_size;
  for (std::size_t k = 0; k < N; ++k) row[5 + k] = v.clip_distance[k];
  for (std::size_t k = 0; k < M; ++k) row[5 + N + k] = v.cull_distance[k];
}
// Layer and viewport are the bits of floats.
template <class R, std::size_t N, std::size_t M, class Row>
HS_INLINE void put_vertex(const LayeredVertex<R, N, M>& v, Row& row) {
  put_vertex(PerVertex<R, N, M>{v.position, v.point_size, v.clip_distance, v.cull_distance}, row);
  row[5 + N + M] = as_real(v.layer);
  row[6 + N + M] = as_real(v.viewport);
}
}  // namespace detail

/// Collects the vertices that a geometry function emits. R: number type; V: varyings of the fragment function; P: vec4<R>, a clip-space
/// position, PerVertex<R, N> or LayeredVertex<R, N>.
template <class R, class V, class P = vec4<R>>
class Emitter {
 public:
  /// Values of a vertex: clip-space position, the extra values of P, and varyings.
  static constexpr std::size_t kRow = 4 + detail::kExtraValues<P> + kComponents<V>;
  using Value = std::conditional_t<std::is_same_v<R, double>, double, float>;

  /// max_vertices: GeometryLayout::max_vertices.
  explicit Emitter(int max_vertices)
      : max_vertices_(max_vertices), rows_(new Value[kWidthOf<R> * static_cast<std::size_t>(max_vertices) * kRow]) {}

  /// Adds a vertex to the current strip of each primitive for which `emits` is true (EmitVertex).
  void emit(const P& vertex, const V& varyings, const MaskOf<R>& emits = MaskOf<R>(true)) {
    std::array<R, kRow> row;
    detail::put_vertex(vertex, row);
    const std::array<R, kComponents<V>> components = to_components<R>(varyings);
    for (std::size_t c = 0; c < components.size(); ++c) row[kRow - components.size() + c] = components[c];
    for (int i = 0; i < kWidthOf<R>; ++i) {
      Primitive& p = primitives_[static_cast<std::size_t>(i)];
      if (!lane(emits, i) || p.count == max_vertices_) continue;
      p.ends[static_cast<std::size_t>(p.count)] = false;
      Value* const to = rows_.get() + index(i, p.count++);
      for (std::size_t c = 0; c < kRow; ++c) to[c] = lane(row[c], i);
    }
  }

  /// Ends the current strip of each primitive for which `ends` is true (EndPrimitive). The next vertex starts a new strip. Strips with too
  /// few vertices for a primitive are dropped. A strip also ends with the function.
  void end_primitive(const MaskOf<R>& ends = MaskOf<R>(true)) {
    for (int i = 0; i < kWidthOf<R>; ++i) {
      Primitive& p = primitives_[static_cast<std::size_t>(i)];
      if (lane(ends, i) && p.count != 0) p.ends[static_cast<std::size_t>(p.count - 1)] = true;
    }
  }

  // These are for the pipeline.

  /// Removes all vertices.
  void clear() { primitives_ = {}; }
  /// Returns the number of vertices emitted for the primitive in lane i.
  int count(int i) const { return primitives_[static_cast<std::size_t>(i)].count; }
  /// Returns the kRow values of a vertex. The vertices of a lane are consecutive.
  const Value* row(int i, int vertex) const { return rows_.get() + index(i, vertex); }
  /// Returns true if a vertex is the last one of its strip.
  bool ends_strip(int i, int vertex) const {
    return vertex + 1 == count(i) || primitives_[static_cast<std::size_t>(i)].ends[static_cast<std::size_t>(vertex)];
  }

 private:
  struct Primitive {
    int count = 0;
    std::bitset<kMaxGeometryVertices> ends{};  // bit k: vertex k is the last one of a strip
  };

  std::size_t index(int i, int vertex) const { return static_cast<std::size_t>(i * max_vertices_ + vertex) * kRow; }

  int max_vertices_;
  std::unique_ptr<Value[]> rows_;  // not initialized
  std::array<Primitive, kWidthOf<R>> primitives_{};
};

}  // namespace halfspace::HS_LANES
