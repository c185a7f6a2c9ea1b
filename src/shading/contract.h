// SPDX-License-Identifier: Apache-2.0
//
// What a shader is: a plain struct whose members are its uniforms, with
//
//   template <class R> struct Attributes { … };      the vertex streams, e.g. vec3<R> position; vec2<R> uv;
//   template <class R> struct Varyings { … };        what the vertex function hands to the fragment function
//   template <class R> vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const;      → clip space
//   template <class R> Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const; → linear colour
//
// and, where it wants them,
//
//   template <class R> Fragment<R> fragment(const Varyings<R>& in) const;
//     for a colour that needs nothing of the pixel but the varyings. With no varyings it is one colour for the whole draw, and
//     is computed once.
//   template <class R> vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const;
//     a vertex function that is told which vertex of which instance it makes.
//   template <class R> struct Primitive { … };       one value a triangle, and the function that makes it, run once
//   template <class R> Primitive<R> primitive(const Varyings<R>& v0, const Varyings<R>& v1, const Varyings<R>& v2) const;
//     per surviving triangle; fragment then takes (const Varyings<R>&, const Primitive<R>&, const Pixel<R>&).
//   PerVertex<R> or PerVertex<R, N> as what vertex returns: a point size and N clip distances beside the position; or
//   PointSpriteVertex<R>: the rectangle that a point covers, for shaders that know the bounds of what they draw in it.
//   template <class R> Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const;
//     the keep mask and depth that fragment will return, without its colour: lets a shader that discards or writes
//     depth be shaded once per visible pixel like an opaque one.
//
// R is float, double or lanes; float and glm::vec3 are uniform, R and vec3<R> vary from pixel to pixel. What fragment
// returns says what it does: Fragment (colour only), DiscardingFragment, DepthFragment; or Fragments<R, N>,
// DiscardingFragmentMRT<R, N>, DepthFragmentMRT<R, N> with a colour for each of N attachments.
#pragma once

#include <array>

#include "halfspace/shading/pixel.h"

namespace halfspace {

/// Which vertex a vertex function makes.
template <class R>
struct VertexId {
  IntOf<R> vertex;   ///< its row in the streams: the index plus DrawState::base_vertex
  int32_t instance;  ///< 0 … DrawState::instances − 1
};

/// What a vertex function returns that says more than the position in clip space.
template <class R, std::size_t clip_distances = 0>
struct PerVertex {
  vec4<R> position;
  R point_size{1.0f};                             ///< px; where points are drawn
  std::array<R, clip_distances> clip_distance{};  ///< at most 8: what lies where one of them is negative is cut away
};

/// What a vertex function of points returns that sets their bounds itself: pixels whose samples lie in the rectangle are drawn.
template <class R>
struct PointSpriteVertex {
  vec2<R> low, high;  ///< normalized device coordinates (x/w, y/w) of its corners
  R depth;            ///< z/w, for the test unless the shader writes depth; clipped at near and far
  MaskOf<R> drawn;    ///< false: there is nothing to draw
};

/// Colour only: linear, straight alpha.
template <class R>
struct Fragment {
  vec4<R> color;
};

/// Colour, and whether the fragment lives (keep false: discard).
template <class R>
struct DiscardingFragment {
  vec4<R> color;
  MaskOf<R> keep;
};

/// Colour, whether the fragment lives, and its window depth in [0, 1] instead of the triangle's.
template <class R>
struct DepthFragment {
  vec4<R> color;
  MaskOf<R> keep;
  R depth;
};

/// The same with N colours: one an attachment, or the two sources of dual source blending.
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

/// What decides visibility: the part of a DepthFragment that is not colour.
template <class R>
struct Visibility {
  MaskOf<R> keep;
  R depth;
};

template <class S>
concept HasAttributes = requires {
  typename S::template Attributes<float>;
};
template <class S>
concept HasVaryings = requires {
  typename S::template Varyings<float>;
};
template <class S>
concept HasPrimitive = requires {
  typename S::template Primitive<float>;
};
namespace detail {
template <class T>
inline constexpr std::size_t kClipDistancesIn = 0;
template <class R, std::size_t N>
inline constexpr std::size_t kClipDistancesIn<PerVertex<R, N>> = N;
template <class T>
inline constexpr bool kIsPerVertex = false;
template <class R, std::size_t N>
inline constexpr bool kIsPerVertex<PerVertex<R, N>> = true;
template <class T>
inline constexpr bool kIsPointSpriteVertex = std::is_same_v<T, PointSpriteVertex<float>>;
}  // namespace detail
/// What a vertex function may return.
template <class T>
concept VertexResult = std::same_as<T, vec4<float>> || detail::kIsPerVertex<T> || detail::kIsPointSpriteVertex<T>;

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
}  // namespace detail
/// What a fragment function may return.
template <class T>
concept FragmentResult = detail::kIsFragment<T>;

template <class S>
concept HasVertexFunctionWithoutId = requires(const S& s, const typename S::template Attributes<float>& in,
                                              typename S::template Varyings<float>& out) {
  { s.vertex(in, out) } -> VertexResult;
};
template <class S>
concept HasVertexIdFunction = requires(const S& s, const typename S::template Attributes<float>& in, const VertexId<float>& id,
                                       typename S::template Varyings<float>& out) {
  { s.vertex(in, id, out) } -> VertexResult;
};
template <class S>
concept HasVertexFunction = HasVertexFunctionWithoutId<S> || HasVertexIdFunction<S>;
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
concept HasPrimitiveFragmentFunction = requires(const S& s, const typename S::template Varyings<float>& in,
                                                const typename S::template Primitive<float>& face, const Pixel<float>& px) {
  s.fragment(in, face, px);
};
template <class S>
concept HasFragmentFunction = (HasPrimitive<S> && HasPrimitiveFunction<S> && HasPrimitiveFragmentFunction<S>) ||
                              (!HasPrimitive<S> && (HasFragmentFunctionOfPixel<S> || HasFragmentFunctionOfVaryings<S>));
template <class S>
concept HasVisibilityFunction = requires(const S& s, const typename S::template Varyings<float>& in, const Pixel<float>& px) {
  { s.visibility(in, px) } -> std::same_as<Visibility<float>>;
};

/// Calls the shader's vertex function, with the vertex's number where it asks for it.
template <class S, class R>
HS_INLINE auto call_vertex(const S& s, const typename S::template Attributes<R>& in, const VertexId<R>& id,
                           typename S::template Varyings<R>& out) {
  if constexpr (HasVertexIdFunction<S>) {
    return s.vertex(in, id, out);
  } else {
    return s.vertex(in, out);
  }
}

/// Calls the shader's fragment function, with its primitive's value where it has one.
template <class S, class R, class P>
HS_INLINE auto call_fragment(const S& s, const typename S::template Varyings<R>& in, const P& face, const Pixel<R>& px) {
  if constexpr (HasPrimitive<S>) {
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
template <class F>
inline constexpr bool kHasDepth = false;
template <class R>
inline constexpr bool kHasDepth<DepthFragment<R>> = true;
template <class R, std::size_t N>
inline constexpr bool kHasDepth<DepthFragmentMRT<R, N>> = true;
template <class C>
inline constexpr std::size_t kColorsIn = 1;
template <class C, std::size_t N>
inline constexpr std::size_t kColorsIn<std::array<C, N>> = N;
template <class R>
HS_INLINE const vec4<R>& nth_color(const vec4<R>& color, std::size_t) {
  return color;
}
template <class R, std::size_t N>
HS_INLINE const vec4<R>& nth_color(const std::array<vec4<R>, N>& colors, std::size_t n) {
  return colors[n];
}
}  // namespace detail

/// The shader's per-triangle value, or an empty struct.
template <class S, class R>
using PrimitiveOf = typename detail::PrimitiveOfT<S, R>::type;

template <class S>
using FragmentOf = decltype(call_fragment<S, float>(std::declval<const S&>(), std::declval<const typename S::template Varyings<float>&>(),
                                                    std::declval<const PrimitiveOf<S, float>&>(), std::declval<const Pixel<float>&>()));

namespace detail {
// A member template that is called visibility, whatever its signature.
template <class S>
concept HasVisibilityMember = requires {
  &S::template visibility<float>;
};
}  // namespace detail

/// What Pass::draw_depth requires of a shader.
template <class S>
concept VertexShader = HasAttributes<S> && HasVaryings<S> && HasVertexFunction<S> &&
    (HasVisibilityFunction<S> || !detail::HasVisibilityMember<S>);

/// What Pass::draw requires of a shader.
template <class S>
concept Shader = VertexShader<S> && HasFragmentFunction<S> && FragmentResult<FragmentOf<S>>;

namespace detail {
// False for every S, but not before S is known.
template <class S>
inline constexpr bool kComplete = false;
}  // namespace detail

/// True if Pass::draw_depth takes S, else a compile-time error that says what S lacks.
template <class S>
consteval bool require_vertex_shader() {
  if constexpr (!HasAttributes<S>) {
    static_assert(detail::kComplete<S>, "the shader lacks: template <class R> struct Attributes { vec3<R> position; … };");
  } else if constexpr (!HasVaryings<S>) {
    static_assert(detail::kComplete<S>, "the shader lacks: template <class R> struct Varyings { … };");
  } else if constexpr (!HasVertexFunction<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader lacks: template <class R> vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const;");
  } else if constexpr (!HasVisibilityFunction<S> && detail::HasVisibilityMember<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader's visibility function must be: template <class R> Visibility<R> visibility(const Varyings<R>& in, "
                  "const Pixel<R>& px) const;");
  }
  return VertexShader<S>;
}

/// True if Pass::draw takes S, else a compile-time error that says what S lacks.
template <class S>
consteval bool require_shader() {
  if constexpr (!require_vertex_shader<S>()) {
    return false;
  } else if constexpr (HasPrimitive<S> && !HasPrimitiveFunction<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader has a Primitive struct and lacks: template <class R> Primitive<R> primitive(const Varyings<R>& v0, "
                  "const Varyings<R>& v1, const Varyings<R>& v2) const;");
  } else if constexpr (HasPrimitive<S> && !HasPrimitiveFragmentFunction<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader has a Primitive struct and lacks: template <class R> Fragment<R> fragment(const Varyings<R>& in, "
                  "const Primitive<R>& face, const Pixel<R>& px) const;");
  } else if constexpr (!HasFragmentFunction<S>) {
    static_assert(detail::kComplete<S>,
                  "the shader lacks: template <class R> Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const;");
  } else {
    static_assert(FragmentResult<FragmentOf<S>>,
                  "the shader's fragment function must return Fragment<R>, DiscardingFragment<R> or DepthFragment<R>, or one of them "
                  "with several colours");
    return Shader<S>;
  }
  return false;
}

template <class S>
using VertexOf =
    decltype(call_vertex<S, float>(std::declval<const S&>(), std::declval<const typename S::template Attributes<float>&>(),
                                   std::declval<const VertexId<float>&>(), std::declval<typename S::template Varyings<float>&>()));
/// Clip distances that the vertex function gives.
template <class S>
inline constexpr std::size_t kClipDistances = detail::kClipDistancesIn<VertexOf<S>>;
/// Does it give a point size?
template <class S>
inline constexpr bool kGivesPointSize = detail::kIsPerVertex<VertexOf<S>>;
/// Does it give the bounds of a sprite?
template <class S>
inline constexpr bool kGivesPointSprite = detail::kIsPointSpriteVertex<VertexOf<S>>;

/// The position in what a vertex function returned; that of a sprite is its depth at w = 1, or at w = −1 if it is not drawn.
template <class R>
HS_INLINE vec4<R> position_of(const vec4<R>& v) {
  return v;
}
template <class R, std::size_t N>
HS_INLINE vec4<R> position_of(const PerVertex<R, N>& v) {
  return v.position;
}
template <class R>
HS_INLINE vec4<R> position_of(const PointSpriteVertex<R>& v) {
  return vec4<R>(R(0.0f), R(0.0f), v.depth, select(v.drawn, R(1.0f), R(-1.0f)));
}

/// How many colours does the shader return?
template <class S>
inline constexpr std::size_t kColors = detail::kColorsIn<decltype(FragmentOf<S>::color)>;
/// May the shader drop a fragment?
template <class S>
inline constexpr bool kDiscards = detail::kIsDiscarding<FragmentOf<S>>;
/// Does the shader replace the triangle's depth?
template <class S>
inline constexpr bool kWritesDepth = detail::kHasDepth<FragmentOf<S>>;
/// Is the shader's colour the same for a whole draw?
template <class S>
inline constexpr bool kIsConstant =
    !HasPrimitive<S> && HasFragmentFunctionOfVaryings<S> && kComponents<typename S::template Varyings<float>> == 0 && !kDiscards<S>;

}  // namespace halfspace
