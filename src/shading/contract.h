// SPDX-License-Identifier: Apache-2.0
//
// The interface of a shader. A shader is a plain struct whose members are its uniforms, with
//
//   template <class R> struct Attributes { … };      the vertex streams, e.g. vec3<R> position; vec2<R> uv; IntOf<R> joint;
//   template <class R> struct Varyings { … };        the values passed from the vertex function to the fragment function
//                                                    (each at most 16 members and 64 components; see shading/varyings.h)
//   template <class R> vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const;      → clip space
//   template <class R> Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const; → linear color
//
// The following are optional:
//
//   template <class R> Fragment<R> fragment(const Varyings<R>& in) const;
//     For colors that depend only on the varyings. Without varyings there is one color per draw call, which is not
//     computed per pixel.
//   template <class R> vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const;
//     A vertex function that also receives the indices of the vertex and the instance.
//   template <class R> struct Primitive { … };       per-triangle values, and the function that computes them
//   template <class R> Primitive<R> primitive(const Varyings<R>& v0, const Varyings<R>& v1, const Varyings<R>& v2) const;
//     Runs once per triangle that survives culling. fragment then has the parameters (const Varyings<R>&, const Primitive<R>&,
//     const Pixel<R>&).
//   template <class R> Fragment<R> fragment(const Varyings<R>& in, const PrimitiveId<R>& id, const Pixel<R>& px) const;
//     A fragment function that also receives the indices of the primitive and the instance, and the barycentric coordinates. It
//     cannot be combined with a Primitive struct.
//   control, evaluate and geometry: functions that divide patches and emit primitives. See tessellation_stage.h and geometry_stage.h.
//   PerVertex<R>, PerVertex<R, N> or PerVertex<R, N, M> as the return type of vertex: adds a point size, N clip distances and M cull
//     distances to the position. LayeredVertex also adds a layer and a viewport.
//   PointSpriteVertex<R> as the return type of vertex: the rectangle that a point covers, for shaders that know the bounds of
//     what they draw in it.
//   template <class R> Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const;
//     Computes the keep mask and the depth that fragment will return, without the color. With it, a shader that discards
//     fragments or writes depth can be shaded once per visible pixel, like an opaque one, and drawn with Pass::draw_depth. Both
//     functions must return the same keep mask and depth; nothing checks that, and if they differ, so can pictures of the same draw.
//     The depth is ignored unless the fragment function returns one.
//
// R is float, double or lanes. float and glm::vec3 are uniform; R and vec3<R> vary per pixel. The return type of fragment states
// what it can do: Fragment (color only), DiscardingFragment or DepthFragment, or their variants FragmentMRT<R, N>,
// DiscardingFragmentMRT<R, N> and DepthFragmentMRT<R, N> with one color for each of N attachments. SampleMasked adds a sample mask.
//
// A shader can have these constants, which change how its fragment function runs:
//
//   static constexpr bool per_sample = true;
//     It runs once per sample, as with DrawState::sample_shading.
//   static constexpr bool early_fragment_tests = true;
//     It runs after the depth and stencil tests and their writes, and cannot change them (GLSL 4.60, section 4.4.1.3). A discarded
//     fragment has no color, and a returned depth is ignored.
//   static constexpr ConservativeDepth conservative_depth = ConservativeDepth::greater;
//     States on which side of the depth of the primitive the returned depth is. More fragments can then be rejected before they are
//     shaded.
#pragma once

#include <array>

#include "halfspace/core/discrete_vec.h"
#include "halfspace/shading/pixel.h"

namespace halfspace::HS_LANES {

/// Identifies the vertex that a vertex function computes.
template <class R>
struct VertexId {
  IntOf<R> vertex;   ///< row in the vertex streams: the index plus DrawState::base_vertex
  int32_t instance;  ///< 0 … DrawState::instances − 1
};

/// Identifies the primitive of a fragment, and the position of the fragment in it.
template <class R>
struct PrimitiveId {
  /// 0, 1, … in submission order, including culled primitives; starts again in each instance. With tessellation or a geometry function,
  /// the number of the submitted patch or primitive.
  IntOf<R> primitive;
  IntOf<R> instance;  ///< 0 … DrawState::instances − 1
  /// Perspective-correct weights of the vertices of the submitted primitive, even if it was clipped. The vertices are in the order of
  /// OpenGL 4.6, table 13.2, which is the index order for lists. Points have the weights (1, 0, 0), lines (1 − t, t, 0).
  vec3<R> barycentrics;
};

/// Return type of vertex functions that output more than the clip-space position. Its point size replaces DrawState::point_size, also if
/// the function only sets distances. There are at most 8 distances. They must be finite.
template <class R, std::size_t clip_distances = 0, std::size_t cull_distances = 0>
struct PerVertex {
  vec4<R> position;
  R point_size{1.0f};                             ///< pixels; used when points are drawn
  std::array<R, clip_distances> clip_distance{};  ///< parts where a distance is negative are clipped
  std::array<R, cull_distances> cull_distance{};  ///< primitives of which a distance is negative at all vertices are not drawn
};

/// The same with a layer and a viewport, as the result of a vertex or an evaluation function or for vertices of a geometry function
/// (EmittedVertex). A primitive has those of its provoking vertex. Primitives with a layer outside of those of the pass are not drawn, and
/// neither are those with a viewport that the draw does not have. In a pass with one layer, the layer has no effect.
template <class R, std::size_t clip_distances = 0, std::size_t cull_distances = 0>
struct LayeredVertex {
  vec4<R> position;
  IntOf<R> layer{0};     ///< gl_Layer
  IntOf<R> viewport{0};  ///< gl_ViewportIndex; see DrawState::viewports
  R point_size{1.0f};
  std::array<R, clip_distances> clip_distance{};
  std::array<R, cull_distances> cull_distance{};
};

/// Return type of vertex functions that compute the bounds of a point. Pixels with a sample inside the rectangle are drawn. The draw
/// must draw points (Topology::points or PolygonMode::point), which is checked.
template <class R>
struct PointSpriteVertex {
  vec2<R> low, high;  ///< corners of the rectangle in NDC (x/w, y/w)
  R depth;            ///< z/w for the depth test, unless the shader writes depth; clipped at near and far
  MaskOf<R> drawn;    ///< false: the point is not drawn
};

/// A color: linear, with straight alpha.
template <class R>
struct Fragment {
  vec4<R> color;
};

/// A color and the keep mask. Fragments with keep == false are discarded.
template <class R>
struct DiscardingFragment {
  vec4<R> color;
  MaskOf<R> keep;
};

/// A color, the keep mask, and a window depth in [0, 1] that replaces the depth of the triangle.
template <class R>
struct DepthFragment {
  vec4<R> color;
  MaskOf<R> keep;
  R depth;
};

/// A fragment with N colors: one per attachment, or the two sources of dual-source blending.
template <class R, std::size_t N>
struct FragmentMRT {
  std::array<vec4<R>, N> color;
};
template <class R, std::size_t N>
struct DiscardingFragmentMRT {
  std::array<vec4<R>, N> color;
  MaskOf<R> keep;
};
template <class R, std::size_t N>
struct DepthFragmentMRT {
  std::array<vec4<R>, N> color;
  MaskOf<R> keep;
  R depth;
};

/// F, which is one of the types above or below, with a sample mask (gl_SampleMask). Of the covered samples, those are drawn whose bit is
/// set: bit s for sample s. It has no effect in passes with one sample per pixel.
template <class R, class F>
struct SampleMasked : F {
  IntOf<R> sample_mask;
};

namespace detail {
template <class R>
HS_INLINE const vec4<R>& color_bits(const vec4<R>& color) {
  return color;
}
template <class R>
HS_INLINE vec4<R> color_bits(const ivec4<R>& color) {
  return {as_real(color.x), as_real(color.y), as_real(color.z), as_real(color.w)};
}
template <class R>
HS_INLINE vec4<R> color_bits(const uvec4<R>& color) {
  return color_bits<R>(ivec4<R>(IntOf<R>(color.x), IntOf<R>(color.y), IntOf<R>(color.z), IntOf<R>(color.w)));
}
}  // namespace detail

/// Colors for attachments of different types, one each: ivec4<R> for signed integers, uvec4<R> for unsigned ones, and vec4<R> for all
/// others.
template <class R, class... Colors>
struct TypedColors {
  std::array<vec4<R>, sizeof...(Colors)> bits;  ///< integers are stored as the bits of floats

  TypedColors() = default;
  HS_INLINE TypedColors(const Colors&... colors) : bits{detail::color_bits<R>(colors)...} {}
};
/// A fragment for attachments of different types. TypedFragment<R, vec4<R>, uvec4<R>> has a color and four unsigned integers.
template <class R, class... Colors>
struct TypedFragment {
  TypedColors<R, Colors...> color;
};
template <class R, class... Colors>
struct DiscardingTypedFragment {
  TypedColors<R, Colors...> color;
  MaskOf<R> keep;
};
template <class R, class... Colors>
struct DepthTypedFragment {
  TypedColors<R, Colors...> color;
  MaskOf<R> keep;
  R depth;
};

/// The depth that a shader returns, compared with that of the primitive (conservative depth, GLSL 4.60, section 4.4.2.1). Returned depths
/// are clamped accordingly, unless one depth is returned for several samples. With assertions (HALFSPACE_ASSERTS), a depth on the wrong
/// side fails a check.
enum class ConservativeDepth : uint8_t {
  any,
  greater,   ///< the same or greater (depth_greater)
  less,      ///< the same or less (depth_less)
  unchanged  ///< the same (depth_unchanged): what the shader returns is not used
};

/// Return type of visibility functions: the part of a DepthFragment that determines visibility.
template <class R>
struct Visibility {
  MaskOf<R> keep;
  R depth;
};

}  // namespace halfspace::HS_LANES
