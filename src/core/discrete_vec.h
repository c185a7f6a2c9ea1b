// SPDX-License-Identifier: Apache-2.0
//
// Vectors of integers and of masks: ivec2<R> … ivec4<R>, uvec2<R> … uvec4<R> and bvec2<R> … bvec4<R>, with the operators of GLSL.
//
// Integers behave as in lane_uint.h for lanes and scalars alike: sums and products wrap, a division by zero has a result, and of a
// shift count the low five bits count. ivec3<R>(v) truncates the components of a vec3<R>, uvec3<R>(i) keeps the bits, and to_real<R>(i)
// converts back. A bvec holds one mask per component, so any(lessThan(a, b)) is a mask that says for each pixel whether any component is
// less.
#pragma once

#include "halfspace/core/component_wise.h"

namespace halfspace::HS_LANES {

template <class R>
using ivec2 = DiscreteVec<2, IntOf<R>>;
template <class R>
using ivec3 = DiscreteVec<3, IntOf<R>>;
template <class R>
using ivec4 = DiscreteVec<4, IntOf<R>>;
template <class R>
using uvec2 = DiscreteVec<2, UintOf<R>>;
template <class R>
using uvec3 = DiscreteVec<3, UintOf<R>>;
template <class R>
using uvec4 = DiscreteVec<4, UintOf<R>>;
template <class R>
using bvec2 = DiscreteVec<2, MaskOf<R>>;
template <class R>
using bvec3 = DiscreteVec<3, MaskOf<R>>;
template <class R>
using bvec4 = DiscreteVec<4, MaskOf<R>>;

namespace detail {

/// Converts a component as a constructor of GLSL does: numbers are truncated, integers keep their bits, true is 1.
template <class To, class From>
HS_INLINE To discrete_cast(const From& from) {
  if constexpr (Number<From> && kIsInt<To>) {
    return truncate_to_int(from);
  } else if constexpr (Number<From> && kIsUint<To>) {
    return truncate_to_uint(from);
  } else if constexpr (kIsMask<From> && Integer<To>) {
    return select(from, To(1), To(0));
  } else if constexpr (kIsMask<To> && !kIsMask<From>) {
    return from != From(0);
  } else {
    return To(from);
  }
}

}  // namespace detail

template <class T>
struct DiscreteVec<2, T> {
  T x, y;

  DiscreteVec() = default;
  HS_INLINE constexpr explicit DiscreteVec(T s) : x(s), y(s) {}
  HS_INLINE constexpr DiscreteVec(T a, T b) : x(a), y(b) {}
  template <detail::VectorOfLength<2> V>
  HS_INLINE constexpr explicit DiscreteVec(const V& v) : x(detail::discrete_cast<T>(v.x)), y(detail::discrete_cast<T>(v.y)) {}

  HS_INLINE constexpr T& operator[](int i) { return i == 0 ? x : y; }
  HS_INLINE constexpr const T& operator[](int i) const { return i == 0 ? x : y; }
};

template <class T>
struct DiscreteVec<3, T> {
  T x, y, z;

  DiscreteVec() = default;
  HS_INLINE constexpr explicit DiscreteVec(T s) : x(s), y(s), z(s) {}
  HS_INLINE constexpr DiscreteVec(T a, T b, T c) : x(a), y(b), z(c) {}
  HS_INLINE constexpr DiscreteVec(const DiscreteVec<2, T>& ab, T c) : x(ab.x), y(ab.y), z(c) {}
  template <detail::VectorOfLength<3> V>
  HS_INLINE constexpr explicit DiscreteVec(const V& v)
      : x(detail::discrete_cast<T>(v.x)), y(detail::discrete_cast<T>(v.y)), z(detail::discrete_cast<T>(v.z)) {}

  HS_INLINE constexpr T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  HS_INLINE constexpr const T& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};

template <class T>
struct DiscreteVec<4, T> {
  T x, y, z, w;

  DiscreteVec() = default;
  HS_INLINE constexpr explicit DiscreteVec(T s) : x(s), y(s), z(s), w(s) {}
  HS_INLINE constexpr DiscreteVec(T a, T b, T c, T d) : x(a), y(b), z(c), w(d) {}
  HS_INLINE constexpr DiscreteVec(const DiscreteVec<2, T>& ab, T c, T d) : x(ab.x), y(ab.y), z(c), w(d) {}
  HS_INLINE constexpr DiscreteVec(const DiscreteVec<3, T>& abc, T d) : x(abc.x), y(abc.y), z(abc.z), w(d) {}
  template <detail::VectorOfLength<4> V>
  HS_INLINE constexpr explicit DiscreteVec(const V& v)
      : x(detail::discrete_cast<T>(v.x)),
        y(detail::discrete_cast<T>(v.y)),
        z(detail::discrete_cast<T>(v.z)),
        w(detail::discrete_cast<T>(v.w)) {}

  HS_INLINE constexpr T& operator[](int i) { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
  HS_INLINE constexpr const T& operator[](int i) const { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
};

/// Converts every component to the nearest number.
template <Number R, int L, Integer T>
HS_INLINE VecN<L, R> to_real(const DiscreteVec<L, T>& v) {
  return detail::map_as<T>([](T c) { return to_real<R>(c); }, v);
}

// ---- operators -------------------------------------------------------------------------------------------------

template <class A, class B>
requires detail::IntegerVectors<A, B> HS_INLINE auto operator+(const A& a, const B& b) {
  return detail::map_integers([](auto x, auto y) { return detail::wrapping(x, y, std::plus()); }, a, b);
}
template <class A, class B>
requires detail::IntegerVectors<A, B> HS_INLINE auto operator-(const A& a, const B& b) {
  return detail::map_integers([](auto x, auto y) { return detail::wrapping(x, y, std::minus()); }, a, b);
}
template <class A, class B>
requires detail::IntegerVectors<A, B> HS_INLINE auto operator*(const A& a, const B& b) {
  return detail::map_integers([](auto x, auto y) { return detail::wrapping(x, y, std::multiplies()); }, a, b);
}
template <class A, class B>
requires detail::IntegerVectors<A, B> HS_INLINE auto operator/(const A& a, const B& b) {
  return detail::map_integers([](auto x, auto y) { return int_divide(x, y); }, a, b);
}
template <class A, class B>
requires detail::IntegerVectors<A, B> HS_INLINE auto operator%(const A& a, const B& b) {
  return detail::map_integers([](auto x, auto y) { return int_modulo(x, y); }, a, b);
}
template <class A, class B>
requires detail::IntegerVectors<A, B> HS_INLINE auto operator&(const A& a, const B& b) {
  return detail::map_integers([](auto x, auto y) { return x & y; }, a, b);
}
template <class A, class B>
requires detail::IntegerVectors<A, B> HS_INLINE auto operator|(const A& a, const B& b) {
  return detail::map_integers([](auto x, auto y) { return x | y; }, a, b);
}
template <class A, class B>
requires detail::IntegerVectors<A, B> HS_INLINE auto operator^(const A& a, const B& b) {
  return detail::map_integers([](auto x, auto y) { return x ^ y; }, a, b);
}
template <int L, Integer T>
HS_INLINE DiscreteVec<L, T> operator-(const DiscreteVec<L, T>& a) {
  return DiscreteVec<L, T>(T(0)) - a;
}
template <int L, Integer T>
HS_INLINE DiscreteVec<L, T> operator~(const DiscreteVec<L, T>& a) {
  return detail::map_as<T>([](T x) { return ~x; }, a);
}
/// The counts may be signed or unsigned, a scalar or a vector.
template <int L, Integer T, class N>
requires detail::ShiftCount<N, L, T> HS_INLINE DiscreteVec<L, T>
operator<<(const DiscreteVec<L, T>& a, const N& n) {
  return detail::map_each([](T x, auto count) { return x << (detail::cast<SignedOf<T>>(count) & 31); }, a, n);
}
template <int L, Integer T, class N>
requires detail::ShiftCount<N, L, T> HS_INLINE DiscreteVec<L, T>
operator>>(const DiscreteVec<L, T>& a, const N& n) {
  return detail::map_each([](T x, auto count) { return x >> (detail::cast<SignedOf<T>>(count) & 31); }, a, n);
}

/// Also written not(a), as in GLSL, because `not` is another spelling of the operator in C++. GLSL 8.6.
template <int L, class M>
requires detail::kIsMask<M> HS_INLINE DiscreteVec<L, M>
operator!(const DiscreteVec<L, M>& a) {
  return detail::map_as<M>([](M x) { return M(!x); }, a);
}

/// Returns where all components are equal.
template <int L, class T>
HS_INLINE auto operator==(const DiscreteVec<L, T>& a, const DiscreteVec<L, T>& b) {
  return detail::fold([](auto x, auto y) { return x && y; }, detail::map_as<T>([](T x, T y) { return detail::equals(x, y); }, a, b));
}
/// Returns where any component differs.
template <int L, class T>
HS_INLINE auto operator!=(const DiscreteVec<L, T>& a, const DiscreteVec<L, T>& b) {
  return !(a == b);
}

template <int L, Integer T, class B>
HS_INLINE DiscreteVec<L, T>& operator+=(DiscreteVec<L, T>& a, const B& b) {
  return a = a + b;
}
template <int L, Integer T, class B>
HS_INLINE DiscreteVec<L, T>& operator-=(DiscreteVec<L, T>& a, const B& b) {
  return a = a - b;
}
template <int L, Integer T, class B>
HS_INLINE DiscreteVec<L, T>& operator*=(DiscreteVec<L, T>& a, const B& b) {
  return a = a * b;
}
template <int L, Integer T, class B>
HS_INLINE DiscreteVec<L, T>& operator/=(DiscreteVec<L, T>& a, const B& b) {
  return a = a / b;
}
template <int L, Integer T, class B>
HS_INLINE DiscreteVec<L, T>& operator%=(DiscreteVec<L, T>& a, const B& b) {
  return a = a % b;
}
template <int L, Integer T, class B>
HS_INLINE DiscreteVec<L, T>& operator&=(DiscreteVec<L, T>& a, const B& b) {
  return a = a & b;
}
template <int L, Integer T, class B>
HS_INLINE DiscreteVec<L, T>& operator|=(DiscreteVec<L, T>& a, const B& b) {
  return a = a | b;
}
template <int L, Integer T, class B>
HS_INLINE DiscreteVec<L, T>& operator^=(DiscreteVec<L, T>& a, const B& b) {
  return a = a ^ b;
}
template <int L, Integer T, class N>
HS_INLINE DiscreteVec<L, T>& operator<<=(DiscreteVec<L, T>& a, const N& n) {
  return a = a << n;
}
template <int L, Integer T, class N>
HS_INLINE DiscreteVec<L, T>& operator>>=(DiscreteVec<L, T>& a, const N& n) {
  return a = a >> n;
}

/// Selects a where m is true and b elsewhere, lane by lane.
template <class M, int L, class T>
requires detail::kIsMask<M> HS_INLINE DiscreteVec<L, T> select(M m, const DiscreteVec<L, T>& a, const DiscreteVec<L, T>& b) {
  return detail::map_as<T>([m](T x, T y) { return select(m, x, y); }, a, b);
}

}  // namespace halfspace::HS_LANES
