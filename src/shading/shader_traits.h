// SPDX-License-Identifier: Apache-2.0
//
// What the pipeline derives from the type of a shader: which functions of the contract it has and what they return, calls of them, and the
// messages of the compiler if a part is missing. The stages before clipping are in vertex_traits.h.
#pragma once

#include <array>
#include <concepts>
#include <type_traits>
#include <utility>

#include "halfspace/core/texel_format.h"
#include "halfspace/shading/vertex_traits.h"

namespace halfspace::HS_LANES {

template <class S>
concept HasPrimitive = requires {
  typename S::template Primitive<float>;
};
namespace detail {
template <class T>
inline constexpr bool kIsFragment = false;
template <class R>
inline constexpr bool kIsFragment<Fragment<R>> = true;
template <class R>
inline constexpr bool kIsFragment<DiscardingFragment<R>> = true;
template <class R>
inline constexpr bool kIsFragment<DepthFragment<R>> = true;
template <class R, std::size_t N>
inline constexpr bool kIsFragment<FragmentMRT<R, N>> = true;
template <class R, std::size_t N>
inline constexpr bool kIsFragment<DiscardingFragmentMRT<R, N>> = true;
template <class R, std::size_t N>
inline constexpr bool kIsFragment<DepthFragmentMRT<R, N>> = true;
template <class R, class... C>
inline constexpr bool kIsFragment<TypedFragment<R, C...>> = true;
template <class R, class... C>
inline constexpr bool kIsFragment<DiscardingTypedFragment<R, C...>> = true;
template <class R, class... C>
inline constexpr bool kIsFragment<DepthTypedFragment<R, C...>> = true;
template <class R, class F>
inline constexpr bool kIsFragment<SampleMasked<R, F>> = kIsFragment<F>;
}  // namespace detail
/// The types that a fragment function may return.
template <class T>
concept FragmentResult = detail::kIsFragment<T>;

template <class S>
concept HasPrimitiveFunction = requires(const S& s, const typename S::template Varyings<float>& v) {
  { s.primitive(v, v, v) } -> std::same_as<typename S::template Primitive<float>>;
};
template <class S>
concept HasFragmentFunctionOfPixel = requires(const S& s, const typename S::template Varyings<float>& in, const Pixel<float>& px) {
  s.fragment(in, px);
};
template <class S>
concept HasFragmentFunctionOfVaryings = requires(const S& s, const typename S::template Varyings<float>& in) {
  s.fragment(in);
};
template <class S>
concept HasFragmentFunctionOfId = requires(const S& s, const typename S::template Varyings<float>& in, const PrimitiveId<float>& id,
                                           const Pixel<float>& px) {
  s.fragment(in, id, px);
};
template <class S>
concept HasPrimitiveFragmentFunction = requires(const S& s, const typename S::template Varyings<float>& in,
                                                const typename S::template Primitive<float>& face, const Pixel<float>& px) {
  s.fragment(in, face, px);
};
template <class S>
concept HasFragmentFunction = (HasPrimitive<S> && HasPrimitiveFunction<S> && HasPrimitiveFragmentFunction<S>) ||
                              (!HasPrimitive<S> &&
                               (HasFragmentFunctionOfPixel<S> || HasFragmentFunctionOfVaryings<S> || HasFragmentFunctionOfId<S>));
template <class S>
concept HasVisibilityFunction = requires(const S& s, const typename S::template Varyings<float>& in, const Pixel<float>& px) {
  { s.visibility(in, px) } -> std::same_as<Visibility<float>>;
};

/// Whether the fragment function has a PrimitiveId parameter.
template <class S>
inline constexpr bool kUsesPrimitiveId = !HasPrimitive<S> && HasFragmentFunctionOfId<S>;

/// Calls the fragment function of the shader, passing the per-triangle value or the primitive ID if it has such a parameter.
template <class S, class R, class P>
HS_INLINE auto call_fragment(const S& s, const typename S::template Varyings<R>& in, const P& face, const Pixel<R>& px) {
  if constexpr (HasPrimitive<S> || kUsesPrimitiveId<S>) {
    return s.fragment(in, face, px);
  } else if constexpr (HasFragmentFunctionOfVaryings<S>) {
    return s.fragment(in);
  } else {
    return s.fragment(in, px);
  }
}

namespace detail {
struct NoPrimitive {};
template <class S, class R>
struct PrimitiveOfT {
  using type = NoPrimitive;
};
template <HasPrimitive S, class R>
struct PrimitiveOfT<S, R> {
  using type = typename S::template Primitive<R>;
};
template <class S, class R>
requires kUsesPrimitiveId<S>
struct PrimitiveOfT<S, R> {
  using type = PrimitiveId<R>;
};
template <class F>
inline constexpr bool kIsDiscarding = false;
template <class R>
inline constexpr bool kIsDiscarding<DiscardingFragment<R>> = true;
template <class R>
inline constexpr bool kIsDiscarding<DepthFragment<R>> = true;
template <class R, std::size_t N>
inline constexpr bool kIsDiscarding<DiscardingFragmentMRT<R, N>> = true;
template <class R, std::size_t N>
inline constexpr bool kIsDiscarding<DepthFragmentMRT<R, N>> = true;
template <class R, class... C>
inline constexpr bool kIsDiscarding<DiscardingTypedFragment<R, C...>> = true;
template <class R, class... C>
inline constexpr bool kIsDiscarding<DepthTypedFragment<R, C...>> = true;
template <class R, class F>
inline constexpr bool kIsDiscarding<SampleMasked<R, F>> = kIsDiscarding<F>;
template <class F>
inline constexpr bool kHasDepth = false;
template <class R>
inline constexpr bool kHasDepth<DepthFragment<R>> = true;
template <class R, std::size_t N>
inline constexpr bool kHasDepth<DepthFragmentMRT<R, N>> = true;
template <class R, class... C>
inline constexpr bool kHasDepth<DepthTypedFragment<R, C...>> = true;
template <class R, class F>
inline constexpr bool kHasDepth<SampleMasked<R, F>> = kHasDepth<F>;
template <class F>
inline constexpr bool kHasSampleMask = false;
template <class R, class F>
inline constexpr bool kHasSampleMask<SampleMasked<R, F>> = true;
template <class C>
inline constexpr std::size_t kColorsIn = 1;
template <class C, std::size_t N>
inline constexpr std::size_t kColorsIn<std::array<C, N>> = N;
template <class R, class... C>
inline constexpr std::size_t kColorsIn<TypedColors<R, C...>> = sizeof...(C);
template <class C>
inline constexpr ColorType kColorType = ColorType::real;
template <class R>
inline constexpr ColorType kColorType<DiscreteVec<4, R>> =
    std::is_same_v<R, int32_t> ? ColorType::signed_integer : ColorType::unsigned_integer;
template <class C>
inline constexpr auto kColorTypesIn = std::array<ColorType, kColorsIn<C>>{};  // all real
template <class R, class... C>
inline constexpr auto kColorTypesIn<TypedColors<R, C...>> = std::array{kColorType<C>...};
template <class R>
HS_INLINE const vec4<R>& nth_color(const vec4<R>& color, std::size_t) {
  return color;
}
template <class R, std::size_t N>
HS_INLINE const vec4<R>& nth_color(const std::array<vec4<R>, N>& colors, std::size_t n) {
  return colors[n];
}
template <class R, class... C>
HS_INLINE const vec4<R>& nth_color(const TypedColors<R, C...>& colors, std::size_t n) {
  return colors.bits[n];
}
}  // namespace detail

/// The per-triangle value of the shader, its PrimitiveId, or an empty struct.
template <class S, class R>
using PrimitiveOf = typename detail::PrimitiveOfT<S, R>::type;

template <class S>
using FragmentOf = decltype(call_fragment<S, float>(std::declval<const S&>(), std::declval<const typename S::template Varyings<float>&>(),
                                                    std::declval<const PrimitiveOf<S, float>&>(), std::declval<const Pixel<float>&>()));

/// Whether depth and stencil are tested and written before the fragment function runs.
template <class S>
inline constexpr bool kTestsEarly = [] {
  if constexpr (requires { S::early_fragment_tests; }) return S::early_fragment_tests;
  return false;
}();

namespace detail {
// S has a member template of this name, of any signature.
template <class S>
concept HasVisibilityMember = requires {
  &S::template visibility<float>;
};
template <class S>
concept HasGeometryMember = requires {
  &S::template geometry<float>;
};
template <class S>
concept HasEvaluateMember = requires {
  &S::template evaluate<float>;
};
template <class S>
concept HasEvaluatedVaryings = requires {
  typename S::template EvaluatedVaryings<float>;
};
template <class S>
concept HasVertexVaryings = requires {
  typename S::template VertexVaryings<float>;
};

template <class S>
consteval bool has_valid_geometry_layout() {
  constexpr GeometryLayout layout = S::geometry_layout;
  return layout.max_vertices >= 1 && layout.max_vertices <= kMaxGeometryVertices && layout.invocations >= 1 &&
         layout.invocations <= kMaxGeometryInvocations;
}
template <class S>
consteval bool has_valid_tessellation_layout() {
  constexpr TessellationLayout layout = S::tessellation_layout;
  return layout.patch_vertices >= 1 && layout.patch_vertices <= kMaxPatchVertices;
}
}  // namespace detail

/// The requirements of Pass::draw_depth.
template <class S>
concept VertexShader = HasAttributes<S> && HasVaryings<S> && HasVertexFunction<S> &&
                       (HasVisibilityFunction<S> ||
                        !detail::HasVisibilityMember<S>)&&(HasTessellationFunctions<S> ||
                                                           (!HasTessellationLayout<S> && !detail::HasEvaluateMember<S>)) &&
                       (HasGeometryFunction<S> || (!HasGeometryLayout<S> && !detail::HasGeometryMember<S>));

/// The requirements of Pass::draw.
template <class S>
concept Shader = VertexShader<S> && HasFragmentFunction<S> && FragmentResult<FragmentOf<S>>;

namespace detail {
// Always false, but dependent on S, so that static_assert fails only on instantiation.
template <class S>
inline constexpr bool kComplete = false;
}  // namespace detail

/// Returns true if Pass::draw_depth accepts S; otherwise compilation fails with a message that says what is missing.
template <class S>
consteval bool require_vertex_shader() {
  if constexpr (!HasAttributes<S>) {
    static_assert(detail::kComplete<S>, "the shader is missing: template <class R> struct Attributes { vec3<R> position; … };");
  } else if constexpr (!HasVaryings<S>) {
    static_assert(detail::kComplete<S>, "the shader is missing: template <class R> struct Varyings { … };");
  } else if constexpr (!HasVertexFunction<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader is missing: template <class R> vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const;");
  } else if constexpr (!HasVisibilityFunction<S> && detail::HasVisibilityMember<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader's visibility function must be: template <class R> Visibility<R> visibility(const Varyings<R>& in, "
                  "const Pixel<R>& px) const;");
  } else if constexpr (!HasTessellationLayout<S> && detail::HasEvaluateMember<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader has an evaluation function but is missing: static constexpr TessellationLayout tessellation_layout{…};");
  } else if constexpr (HasTessellationLayout<S> && !HasTessellationFunctions<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader has a tessellation layout but is missing: template <class R> TessellationLevels<R> control(const "
                  "PatchInput<R, Varyings<R>, N>& in) const; or: template <class R> vec4<R> evaluate(const PatchInput<R, Varyings<R>, N>& "
                  "in, const vec3<R>& at, Varyings<R>& out) const; N is tessellation_layout.patch_vertices. With a Patch, it follows `in` "
                  "as a parameter; "
                  "VertexVaryings and EvaluatedVaryings replace Varyings (shading/tessellation_stage.h)");
  } else if constexpr (!HasGeometryLayout<S> && detail::HasGeometryMember<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader has a geometry function but is missing: static constexpr GeometryLayout geometry_layout{…};");
  } else if constexpr (HasGeometryLayout<S> && !HasGeometryFunction<S>) {
    static_assert(
        detail::kComplete<S>,
        "the shader has a geometry layout but is missing: template <class R> void geometry(const GeometryInput<R, Varyings<R>, N>& "
        "in, Emitter<R, Varyings<R>>& out) const; N is the number of vertices of geometry_layout.input. Other types if the shader has "
        "them: VertexVaryings or EvaluatedVaryings in GeometryInput, EmittedVertex in Emitter (shading/geometry_stage.h)");
  } else if constexpr (detail::HasEvaluatedVaryings<S> && !(HasTessellationLayout<S> && HasGeometryLayout<S>)) {
    static_assert(
        detail::kComplete<S>,
        "the shader has EvaluatedVaryings, but not both an evaluation function that writes and a geometry function that reads them");
  } else if constexpr (detail::HasVertexVaryings<S> && !HasTessellationLayout<S> && !HasGeometryLayout<S>) {
    static_assert(detail::kComplete<S>, "the shader has VertexVaryings but neither an evaluation nor a geometry function, which read them");
  } else {
    using V = typename S::template Varyings<float>;
    static_assert(kClipDistances<S> + kCullDistances<S> <= 8, "the vertices of the shader have more than 8 clip and cull distances");
    if constexpr (HasTessellationLayout<S>) {
      static_assert(detail::has_valid_tessellation_layout<S>(),
                    "the number of vertices in the patches of the shader is outside of its range: expected 1 to 32");
      static_assert(kComponents<PatchOf<S, float>> <= kMaxPatchComponents, "the Patch of the shader has more than 256 components");
      static_assert(kComponents<EvaluatedVaryingsOf<S, float>> <= kMaxComponents,
                    "the EvaluatedVaryings of the shader have more than 64 components");
    }
    if constexpr (HasGeometryLayout<S>) {
      static_assert(detail::has_valid_geometry_layout<S>(),
                    "the geometry layout of the shader is outside of its range: expected 1 to 256 vertices and 1 to 32 invocations");
    }
    if constexpr (HasTessellationLayout<S> || HasGeometryLayout<S>) {
      static_assert(
          !std::is_same_v<VertexOf<S>, PointSpriteVertex<float>>,
          "the vertex function of the shader returns a PointSpriteVertex, which tessellation and geometry functions cannot receive");
    }
    static_assert(kComponents<VertexVaryingsOf<S, float>> <= kMaxComponents,
                  "the VertexVaryings of the shader have more than 64 components");
    static_assert(!kInterpolatesIntegers<V>, "the shader interpolates integer varyings: declare them as Flat<IntOf<R>>");
    static_assert(kComponents<V> <= kMaxComponents, "the varyings of the shader have more than 64 components");
  }
  return VertexShader<S>;
}

/// Returns true if Pass::draw_depth draws S as Pass::draw does; otherwise compilation fails with a message that says what is missing.
template <class S>
consteval bool require_depth_shader() {
  if constexpr (!require_vertex_shader<S>()) {
    return false;
  } else if constexpr (HasFragmentFunction<S>) {
    using F = FragmentOf<S>;
    static_assert(HasVisibilityFunction<S> || kTestsEarly<S> || (!detail::kIsDiscarding<F> && !detail::kHasDepth<F>),
                  "draw_depth() does not call the fragment function, but that of this shader discards or returns a depth; the shader is "
                  "missing: template <class R> Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const;");
    static_assert(kTestsEarly<S> || !detail::kHasSampleMask<F>,
                  "draw_depth() does not call the fragment function, but that of the shader returns a sample mask: use draw()");
  }
  return true;
}

/// Returns true if Pass::draw accepts S; otherwise compilation fails with a message that says what is missing.
template <class S>
consteval bool require_shader() {
  if constexpr (!require_vertex_shader<S>()) {
    return false;
  } else if constexpr (HasPrimitive<S> && !HasPrimitiveFunction<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader has a Primitive struct but is missing: template <class R> Primitive<R> primitive(const Varyings<R>& v0, "
                  "const Varyings<R>& v1, const Varyings<R>& v2) const;");
  } else if constexpr (HasPrimitive<S> && !HasPrimitiveFragmentFunction<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader has a Primitive struct but is missing: template <class R> Fragment<R> fragment(const Varyings<R>& in, "
                  "const Primitive<R>& face, const Pixel<R>& px) const;");
  } else if constexpr (!HasFragmentFunction<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader is missing: template <class R> Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const;");
  } else {
    static_assert(detail::kIsFragment<FragmentOf<S>>,
                  "the shader's fragment function must return Fragment<R>, DiscardingFragment<R> or DepthFragment<R>, or one of "
                  "their variants for several colors");
    static_assert(!HasVisibilityFunction<S> || detail::kIsDiscarding<FragmentOf<S>>,
                  "the shader has a visibility function, but its fragment function neither discards nor returns a depth: return a "
                  "DiscardingFragment<R> or a DepthFragment<R>");
    return Shader<S>;
  }
  return false;
}

/// Number of colors that the shader returns.
template <class S>
inline constexpr std::size_t kColors = detail::kColorsIn<decltype(FragmentOf<S>::color)>;
/// The types of these colors.
template <class S>
inline constexpr auto kColorTypes = detail::kColorTypesIn<decltype(FragmentOf<S>::color)>;
/// Whether the shader may discard fragments.
template <class S>
inline constexpr bool kDiscards = detail::kIsDiscarding<FragmentOf<S>>;
/// The promise of the shader about the depth that it returns.
template <class S>
inline constexpr ConservativeDepth kConservativeDepth = [] {
  if constexpr (requires { S::conservative_depth; }) return S::conservative_depth;
  return ConservativeDepth::any;
}();
/// Whether the shader replaces the depth of the triangle.
template <class S>
inline constexpr bool kWritesDepth =
    detail::kHasDepth<FragmentOf<S>> && !kTestsEarly<S> && kConservativeDepth<S> != ConservativeDepth::unchanged;
/// Whether the shader returns a sample mask.
template <class S>
inline constexpr bool kWritesSampleMask = detail::kHasSampleMask<FragmentOf<S>>;
/// Whether the fragment function runs once per sample, for any state.
template <class S>
inline constexpr bool kRunsPerSample = [] {
  bool per_sample = kUsesPerSample<typename S::template Varyings<float>>;
  if constexpr (requires { S::per_sample; }) per_sample |= S::per_sample;
  return per_sample;
}();
/// Whether the shader has a single color for the whole draw call.
template <class S>
inline constexpr bool kIsConstant = !HasPrimitive<S> && HasFragmentFunctionOfVaryings<S> &&
                                    kComponents<typename S::template Varyings<float>> == 0 && !kDiscards<S> && !kWritesSampleMask<S>;

}  // namespace halfspace::HS_LANES
