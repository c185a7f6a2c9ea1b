// SPDX-License-Identifier: Apache-2.0
//
// What the pipeline derives from the type of a shader about the stages before clipping: its vertex, control, evaluation and geometry
// functions, what they exchange, and calls of them.
#pragma once

#include <array>
#include <concepts>
#include <type_traits>
#include <utility>

#include "halfspace/shading/contract.h"
#include "halfspace/shading/geometry_stage.h"
#include "halfspace/shading/tessellation_stage.h"
#include "halfspace/shading/varyings.h"

namespace halfspace::HS_LANES {

// ---- what the stages exchange ----------------------------------------------------------------------------------

template <class S>
concept HasAttributes = requires {
  typename S::template Attributes<float>;
};
template <class S>
concept HasVaryings = requires {
  typename S::template Varyings<float>;
};
template <class S>
concept HasGeometryLayout = requires {
  { S::geometry_layout } -> std::convertible_to<const GeometryLayout&>;
};

template <class S>
concept HasTessellationLayout = requires {
  { S::tessellation_layout } -> std::convertible_to<const TessellationLayout&>;
};
template <class S>
concept HasPatch = requires {
  typename S::template Patch<float>;
};

namespace detail {
template <class S, class R>
struct VertexVaryingsOfT {
  using type = typename S::template Varyings<R>;
};
template <class S, class R>
requires requires { typename S::template VertexVaryings<R>; }
struct VertexVaryingsOfT<S, R> {
  using type = typename S::template VertexVaryings<R>;
};
template <class S, class R>
struct EvaluatedVaryingsOfT {
  using type = typename S::template Varyings<R>;
};
template <class S, class R>
requires requires { typename S::template EvaluatedVaryings<R>; }
struct EvaluatedVaryingsOfT<S, R> {
  using type = typename S::template EvaluatedVaryings<R>;
};
// What the geometry function reads: the outputs of the evaluation function or, without tessellation, of the vertex function.
template <class S, class R>
struct GeometryVaryingsOfT : VertexVaryingsOfT<S, R> {};
template <HasTessellationLayout S, class R>
struct GeometryVaryingsOfT<S, R> : EvaluatedVaryingsOfT<S, R> {};
struct NoPatch {};
template <class S, class R>
struct PatchOfT {
  using type = NoPatch;
};
template <HasPatch S, class R>
struct PatchOfT<S, R> {
  using type = typename S::template Patch<R>;
};
template <class S, class R>
struct EmittedVertexOfT {
  using type = vec4<R>;
};
template <class S, class R>
requires requires { typename S::template EmittedVertex<R>; }
struct EmittedVertexOfT<S, R> {
  using type = typename S::template EmittedVertex<R>;
};
}  // namespace detail
/// The outputs of the vertex function: VertexVaryings of a shader that has them, else Varyings.
template <class S, class R>
using VertexVaryingsOf = typename detail::VertexVaryingsOfT<S, R>::type;
/// The outputs of the evaluation function: EvaluatedVaryings of a shader that has them, else Varyings.
template <class S, class R>
using EvaluatedVaryingsOf = typename detail::EvaluatedVaryingsOfT<S, R>::type;
/// The input of the control and the evaluation function.
template <class S, class R>
using PatchInputOf = PatchInput<R, VertexVaryingsOf<S, R>, static_cast<std::size_t>(S::tessellation_layout.patch_vertices)>;
/// The values of a patch, or an empty struct.
template <class S, class R>
using PatchOf = typename detail::PatchOfT<S, R>::type;
/// The varyings that the geometry function reads.
template <class S, class R>
using GeometryVaryingsOf = typename detail::GeometryVaryingsOfT<S, R>::type;
/// The input of the geometry function.
template <class S, class R>
using GeometryInputOf = GeometryInput<R, GeometryVaryingsOf<S, R>, static_cast<std::size_t>(vertices_of(S::geometry_layout.input))>;
/// The output of the geometry function.
template <class S, class R>
using EmitterOf = Emitter<R, typename S::template Varyings<R>, typename detail::EmittedVertexOfT<S, R>::type>;

namespace detail {
template <class T>
inline constexpr std::size_t kClipDistancesIn = 0;
template <class R, std::size_t N, std::size_t M>
inline constexpr std::size_t kClipDistancesIn<PerVertex<R, N, M>> = N;
template <class R, std::size_t N, std::size_t M>
inline constexpr std::size_t kClipDistancesIn<LayeredVertex<R, N, M>> = N;
template <class T>
inline constexpr std::size_t kCullDistancesIn = 0;
template <class R, std::size_t N, std::size_t M>
inline constexpr std::size_t kCullDistancesIn<PerVertex<R, N, M>> = M;
template <class R, std::size_t N, std::size_t M>
inline constexpr std::size_t kCullDistancesIn<LayeredVertex<R, N, M>> = M;
template <class T>
inline constexpr bool kIsLayeredVertex = false;
template <class R, std::size_t N, std::size_t M>
inline constexpr bool kIsLayeredVertex<LayeredVertex<R, N, M>> = true;
template <class T>
inline constexpr bool kIsPerVertex = false;
template <class R, std::size_t N, std::size_t M>
inline constexpr bool kIsPerVertex<PerVertex<R, N, M>> = true;
template <class T>
inline constexpr bool kIsPointSpriteVertex = std::is_same_v<T, PointSpriteVertex<float>>;
}  // namespace detail
/// The types that an evaluation function may return.
template <class T>
concept EvaluationResult = std::same_as<T, vec4<float>> || detail::kIsPerVertex<T> || detail::kIsLayeredVertex<T>;
/// The types that a vertex function may return.
template <class T>
concept VertexResult = EvaluationResult<T> || detail::kIsPointSpriteVertex<T>;

// ---- functions -------------------------------------------------------------------------------------------------

template <class S>
concept HasVertexFunctionWithoutId = requires(const S& s, const typename S::template Attributes<float>& in,
                                              VertexVaryingsOf<S, float>& out) {
  { s.vertex(in, out) } -> VertexResult;
};
template <class S>
concept HasVertexIdFunction = requires(const S& s, const typename S::template Attributes<float>& in, const VertexId<float>& id,
                                       VertexVaryingsOf<S, float>& out) {
  { s.vertex(in, id, out) } -> VertexResult;
};
template <class S>
concept HasVertexFunction = HasVertexFunctionWithoutId<S> || HasVertexIdFunction<S>;
/// Calls the vertex function of the shader, passing the vertex ID if it has such a parameter.
template <class S, class R>
HS_INLINE auto call_vertex(const S& s, const typename S::template Attributes<R>& in, const VertexId<R>& id, VertexVaryingsOf<S, R>& out) {
  if constexpr (HasVertexIdFunction<S>) {
    return s.vertex(in, id, out);
  } else {
    return s.vertex(in, out);
  }
}

/// Calls the control function of the shader, passing the values of the patch if there are any.
template <class S, class R>
HS_INLINE auto call_control(const S& s, const PatchInputOf<S, R>& in, PatchOf<S, R>& patch) {
  if constexpr (HasPatch<S>) {
    return s.control(in, patch);
  } else {
    return s.control(in);
  }
}
/// Calls the evaluation function in the same way.
template <class S, class R>
HS_INLINE auto call_evaluate(const S& s, const PatchInputOf<S, R>& in, const PatchOf<S, R>& patch, const vec3<R>& at,
                             EvaluatedVaryingsOf<S, R>& out) {
  if constexpr (HasPatch<S>) {
    return s.evaluate(in, patch, at, out);
  } else {
    return s.evaluate(in, at, out);
  }
}
namespace detail {
template <class S>
using EvaluateResultOf = decltype(call_evaluate<S, float>(std::declval<const S&>(), std::declval<const PatchInputOf<S, float>&>(),
                                                          std::declval<const PatchOf<S, float>&>(), std::declval<const vec3<float>&>(),
                                                          std::declval<EvaluatedVaryingsOf<S, float>&>()));
template <class S>
concept HasControl = requires(const S& s, const PatchInputOf<S, float>& in, PatchOf<S, float>& patch) {
  requires(HasPatch<S> &&
           requires {
             { s.control(in, patch) } -> std::same_as<TessellationLevels<float>>;
           }) ||
      (!HasPatch<S> && requires {
        { s.control(in) } -> std::same_as<TessellationLevels<float>>;
      });
};
template <class S>
concept HasEvaluate = requires(const S& s, const PatchInputOf<S, float>& in, const PatchOf<S, float>& patch, const vec3<float>& at,
                               EvaluatedVaryingsOf<S, float>& out) {
  requires(HasPatch<S> &&
           requires {
             { s.evaluate(in, patch, at, out) } -> EvaluationResult;
           }) ||
      (!HasPatch<S> && requires {
        { s.evaluate(in, at, out) } -> EvaluationResult;
      });
};
}  // namespace detail
template <class S>
concept HasTessellationFunctions = HasTessellationLayout<S> && detail::HasControl<S> && detail::HasEvaluate<S>;
template <class S>
concept HasGeometryFunction = HasGeometryLayout<S> && EvaluationResult<typename detail::EmittedVertexOfT<S, float>::type> &&
    requires(const S& s, const GeometryInputOf<S, float>& in, EmitterOf<S, float>& out) {
  s.geometry(in, out);
};

// ---- the vertices that are clipped -----------------------------------------------------------------------------

template <class S>
using VertexOf = decltype(call_vertex<S, float>(std::declval<const S&>(), std::declval<const typename S::template Attributes<float>&>(),
                                                std::declval<const VertexId<float>&>(), std::declval<VertexVaryingsOf<S, float>&>()));
namespace detail {
template <class S>
struct LastVertexOfT {
  using type = VertexOf<S>;
};
template <class S>
requires(HasTessellationLayout<S> && !HasGeometryLayout<S>) struct LastVertexOfT<S> {
  using type = EvaluateResultOf<S>;
};
template <HasGeometryLayout S>
struct LastVertexOfT<S> {
  using type = typename EmittedVertexOfT<S, float>::type;
};
}  // namespace detail
/// What the last function before clipping returns for a vertex: the geometry, the evaluation or the vertex function.
template <class S>
using LastVertexOf = typename detail::LastVertexOfT<S>::type;
/// Number of clip distances of a vertex.
template <class S>
inline constexpr std::size_t kClipDistances = detail::kClipDistancesIn<LastVertexOf<S>>;
/// Number of cull distances of a vertex.
template <class S>
inline constexpr std::size_t kCullDistances = detail::kCullDistancesIn<LastVertexOf<S>>;
/// Whether vertices have a point size.
template <class S>
inline constexpr bool kGivesPointSize = detail::kIsPerVertex<LastVertexOf<S>> || detail::kIsLayeredVertex<LastVertexOf<S>>;
/// Whether vertices have a layer and a viewport.
template <class S>
inline constexpr bool kGivesLayer = detail::kIsLayeredVertex<LastVertexOf<S>>;
/// Whether vertices have the bounds of a point sprite.
template <class S>
inline constexpr bool kGivesPointSprite = detail::kIsPointSpriteVertex<LastVertexOf<S>>;

/// Returns the clip-space position in the result of a vertex function. For a point sprite this is (0, 0, depth, 1), or w = −1 if
/// it is not drawn.
template <class R>
HS_INLINE vec4<R> position_of(const vec4<R>& v) {
  return v;
}
template <class R, std::size_t N, std::size_t M>
HS_INLINE vec4<R> position_of(const PerVertex<R, N, M>& v) {
  return v.position;
}
template <class R, std::size_t N, std::size_t M>
HS_INLINE vec4<R> position_of(const LayeredVertex<R, N, M>& v) {
  return v.position;
}
template <class R>
HS_INLINE vec4<R> position_of(const PointSpriteVertex<R>& v) {
  return vec4<R>(R(0.0f), R(0.0f), v.depth, select(v.drawn, R(1.0f), R(-1.0f)));
}

}  // namespace halfspace::HS_LANES
