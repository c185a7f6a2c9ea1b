// SPDX-License-Identifier: Apache-2.0
//
// Applies a function of scalars to the components of vectors, for functions that accept what GLSL calls a genType: a scalar, or vectors of
// one length and scalars that stand for all components. As for operators, uniforms (glm::vec3, float) mix with varying arguments, as long
// as one of the arguments varies.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>

#include "halfspace/core/lane_uint.h"
#include "halfspace/core/vec.h"

namespace halfspace::HS_LANES {

/// A vector of L integers or masks (discrete_vec.h).
template <int L, class T>
struct DiscreteVec;

namespace detail {

/// The length of an argument, 0 for a scalar, and the type of its components.
template <class A>
struct Operand {
  static constexpr int length = 0;
  static constexpr bool is_uniform = std::is_arithmetic_v<A>;
  using Component = A;
};
template <int L, Number R>
struct Operand<VecN<L, R>> {
  static constexpr int length = L;
  static constexpr bool is_uniform = false;
  using Component = R;
};
template <int L, class T>
struct Operand<DiscreteVec<L, T>> {
  static constexpr int length = L;
  static constexpr bool is_uniform = false;
  using Component = T;
};
template <int L, class S, glm::qualifier Q>
struct Operand<glm::vec<L, S, Q>> {
  static constexpr int length = L;
  static constexpr bool is_uniform = true;
  using Component = S;
};

template <class A>
using ComponentOf = typename Operand<A>::Component;
template <class A>
inline constexpr int kLengthOf = Operand<A>::length;
/// The common length of the arguments, 0 if all are scalars.
template <class... A>
inline constexpr int kCommonLength = std::max({kLengthOf<A>...});
template <class... A>
inline constexpr bool kLengthsMatch = ((kLengthOf<A> == 0 || kLengthOf<A> == kCommonLength<A...>)&&...);
/// At least one argument is a vector of Halfspace.
template <class... A>
inline constexpr bool kHasVector = ((kLengthOf<A> != 0 && !Operand<A>::is_uniform) || ...);

template <class V, int L>
concept VectorOfLength = kLengthOf<V>
== L&& L != 0;

/// The first of the types that Test accepts, or void.
template <template <class> class Test, class... A>
struct First : std::type_identity<void> {};
template <template <class> class Test, class A, class... Rest>
struct First<Test, A, Rest...> : std::conditional_t<Test<A>::value, std::type_identity<ComponentOf<A>>, First<Test, Rest...>> {};

template <class A>
struct HasLanes : std::bool_constant<kIsLanes<ComponentOf<A>>> {};
template <class A>
struct IsVectorOfNumbers : std::bool_constant<kLengthOf<A> != 0 && !Operand<A>::is_uniform && Number<ComponentOf<A>>> {};
template <class A>
struct IsNumber : std::bool_constant<Number<ComponentOf<A>>> {};
template <class A>
struct HasIntegerLanes : std::bool_constant<IntegerLanes<ComponentOf<A>>> {};
template <class A>
struct IsVectorOfIntegers : std::bool_constant<kLengthOf<A> != 0 && !Operand<A>::is_uniform && Integer<ComponentOf<A>>> {};
template <class A>
struct IsInteger : std::bool_constant<Integer<ComponentOf<A>>> {};

template <class A, class B>
using Or = std::conditional_t<std::is_void_v<A>, B, A>;

/// The number type that a function of these arguments computes with: that of lanes, else that of a vector, else that of the first scalar.
template <class... A>
using NumberOf =
    Or<typename First<HasLanes, A...>::type, Or<typename First<IsVectorOfNumbers, A...>::type, typename First<IsNumber, A...>::type>>;
/// The same for integers.
template <class... A>
using IntegerOf = Or<typename First<HasIntegerLanes, A...>::type,
                     Or<typename First<IsVectorOfIntegers, A...>::type, typename First<IsInteger, A...>::type>>;

/// A converts to T: it has components of type T, or of a uniform type. Numbers in the code of a shader may be doubles or integers.
template <class A, class T>
concept ConvertsTo = std::same_as<ComponentOf<A>, T> || WidensTo<ComponentOf<A>, T> ||
    (kLengthOf<A> == 0 && std::is_arithmetic_v<A> && !std::same_as<A, bool>);

/// Arguments of a function of numbers: scalars, or at least one vector of Halfspace, and vectors of one length.
template <class... A>
concept NumberArguments = !std::is_void_v<NumberOf<A...>> && kLengthsMatch<A...> && (ConvertsTo<A, NumberOf<A...>> && ...) &&
                          (kCommonLength<A...> == 0 || kHasVector<A...>);
template <class... A>
concept NumberVectors = NumberArguments<A...> && kCommonLength<A...>
!= 0;

/// The same for integers. Signed and unsigned ones do not mix, except that uniforms convert.
template <class... A>
concept IntegerArguments =
    !std::is_void_v<IntegerOf<A...>> && kLengthsMatch<A...> &&
    ((std::same_as<ComponentOf<A>, IntegerOf<A...>> || (kLengthOf<A> == 0 && std::is_integral_v<A> && !std::same_as<A, bool>)) && ...);
template <class... A>
concept IntegerVectors = IntegerArguments<A...> && kHasVector<A...>;

/// N can be the count of a shift of a DiscreteVec<L, T>.
template <class N, int L, class T>
concept ShiftCount = (kLengthOf<N> == 0 || kLengthOf<N> == L) && (Integer<ComponentOf<N>> || std::is_integral_v<N>);

template <int L, class T>
struct VectorT : std::type_identity<DiscreteVec<L, T>> {};
template <int L, Number R>
struct VectorT<L, R> : std::type_identity<VecN<L, R>> {};
template <class T>
struct VectorT<0, T> : std::type_identity<T> {};
template <Number R>
struct VectorT<0, R> : std::type_identity<R> {};
/// The vector type with L components of type T; T itself if L is 0.
template <int L, class T>
using VectorOf = typename VectorT<L, T>::type;

/// Converts a component or a scalar to T.
template <class T, class A>
HS_INLINE T cast(const A& a) {
  if constexpr (std::is_arithmetic_v<A> && kIsLanes<T>) {
    return T(static_cast<float>(a));
  } else if constexpr (std::is_arithmetic_v<A> && IntegerLanes<T>) {
    return T(static_cast<std::conditional_t<kIsUint<T>, uint32_t, int32_t>>(a));
  } else {
    return static_cast<T>(a);
  }
}
/// Returns component i of a vector, or the scalar, as a T.
template <class T, class A>
HS_INLINE T component(const A& a, int i) {
  if constexpr (kLengthOf<A> != 0) {
    return cast<T>(a[i]);
  } else {
    return cast<T>(a);
  }
}

template <class T, int i, class F, class... A>
HS_INLINE auto at(F f, const A&... a) {
  return f(component<T>(a, i)...);
}
template <class T, class F, int... I, class... A>
HS_INLINE auto map_indices(F f, std::integer_sequence<int, I...>, const A&... a) {
  return VectorOf<sizeof...(I), decltype(at<T, 0>(f, a...))>{at<T, I>(f, a...)...};
}

/// Applies f to the components of the arguments, converted to T. The result is a scalar if all arguments are.
template <class T, class F, class... A>
HS_INLINE auto map_as(F f, const A&... a) {
  constexpr int length = kCommonLength<A...>;
  if constexpr (length == 0) {
    return at<T, 0>(f, a...);
  } else {
    return map_indices<T>(f, std::make_integer_sequence<int, length>(), a...);
  }
}
template <class F, class... A>
requires NumberArguments<A...> HS_INLINE auto map_numbers(F f, const A&... a) { return map_as<NumberOf<A...>>(f, a...); }
template <class F, class... A>
requires IntegerArguments<A...> HS_INLINE auto map_integers(F f, const A&... a) { return map_as<IntegerOf<A...>>(f, a...); }

template <class... A>
struct AlikeT : std::type_identity<IntegerOf<A...>> {};
template <class... A>
requires NumberArguments<A...>
struct AlikeT<A...> : std::type_identity<NumberOf<A...>> {
};
/// The type that a function of numbers or of integers computes with.
template <class... A>
using AlikeOf = typename AlikeT<A...>::type;
template <class F, class... A>
HS_INLINE auto map_alike(F f, const A&... a) {
  return map_as<AlikeOf<A...>>(f, a...);
}

/// Applies f to components of different types, which are not converted.
template <int i, class F, class... A>
HS_INLINE auto at_each(F f, const A&... a) {
  return f(component<ComponentOf<A>>(a, i)...);
}
template <class F, int... I, class... A>
HS_INLINE auto map_each_index(F f, std::integer_sequence<int, I...>, const A&... a) {
  return VectorOf<sizeof...(I), decltype(at_each<0>(f, a...))>{at_each<I>(f, a...)...};
}
template <class F, class... A>
HS_INLINE auto map_each(F f, const A&... a) {
  constexpr int length = kCommonLength<A...>;
  if constexpr (length == 0) {
    return at_each<0>(f, a...);
  } else {
    return map_each_index(f, std::make_integer_sequence<int, length>(), a...);
  }
}

/// Combines the components of v with f, from the first to the last.
template <class F, class V>
HS_INLINE auto fold(F f, const V& v) {
  auto r = f(v[0], v[1]);
  for (int i = 2; i < kLengthOf<V>; ++i) r = f(r, v[i]);
  return r;
}

/// Compares integers or masks.
template <class T>
HS_INLINE auto equals(T a, T b) {
  if constexpr (kIsMask<T>) {
    return !(a ^ b);
  } else {
    return a == b;
  }
}

}  // namespace detail

}  // namespace halfspace::HS_LANES
