// SPDX-License-Identifier: Apache-2.0
//
// The vector relational functions of GLSL 3.30, section 8.6. They compare vectors component by component and return a bvec. All are exact.
// not(b) is operator! in discrete_vec.h.
#pragma once

#include "halfspace/core/discrete_vec.h"

namespace halfspace::HS_LANES {

namespace detail {
/// Arguments of a comparison: numbers or integers, at least one of which is a vector.
template <class... A>
concept OrderedVectors = NumberVectors<A...> || IntegerVectors<A...>;
template <class A, class B>
inline constexpr bool kAreMaskVectors = false;
template <int L, class M>
inline constexpr bool kAreMaskVectors<DiscreteVec<L, M>, DiscreteVec<L, M>> = kIsMask<M>;
template <class A, class B>
concept MaskVectors = kAreMaskVectors<A, B>;
}  // namespace detail

/// Where x < y; false if either is NaN. GLSL 8.6.
template <class X, class Y>
requires detail::OrderedVectors<X, Y> HS_INLINE auto lessThan(const X& x, const Y& y) {
  return detail::map_alike([](auto a, auto b) { return a < b; }, x, y);
}
/// Where x <= y; false if either is NaN. GLSL 8.6.
template <class X, class Y>
requires detail::OrderedVectors<X, Y> HS_INLINE auto lessThanEqual(const X& x, const Y& y) {
  return detail::map_alike([](auto a, auto b) { return a <= b; }, x, y);
}
/// Where x > y; false if either is NaN. GLSL 8.6.
template <class X, class Y>
requires detail::OrderedVectors<X, Y> HS_INLINE auto greaterThan(const X& x, const Y& y) {
  return detail::map_alike([](auto a, auto b) { return a > b; }, x, y);
}
/// Where x >= y; false if either is NaN. GLSL 8.6.
template <class X, class Y>
requires detail::OrderedVectors<X, Y> HS_INLINE auto greaterThanEqual(const X& x, const Y& y) {
  return detail::map_alike([](auto a, auto b) { return a >= b; }, x, y);
}
/// Where x == y; false if either is NaN. GLSL 8.6.
template <class X, class Y>
requires detail::OrderedVectors<X, Y> HS_INLINE auto equal(const X& x, const Y& y) {
  return detail::map_alike([](auto a, auto b) { return a == b; }, x, y);
}
template <class X, class Y>
requires detail::MaskVectors<X, Y> HS_INLINE X equal(const X& x, const Y& y) {
  return detail::map_each([]<class M>(M a, M b) { return M(!(a ^ b)); }, x, y);
}
/// Where x != y; true if either is NaN. GLSL 8.6.
template <class X, class Y>
requires detail::OrderedVectors<X, Y> HS_INLINE auto notEqual(const X& x, const Y& y) {
  return detail::map_alike([](auto a, auto b) { return a != b; }, x, y);
}
template <class X, class Y>
requires detail::MaskVectors<X, Y> HS_INLINE X notEqual(const X& x, const Y& y) {
  return detail::map_each([]<class M>(M a, M b) { return M(a ^ b); }, x, y);
}

/// Where any component of v is true: a mask, unlike any(mask), which combines lanes. GLSL 8.6.
template <int L, class M>
requires detail::kIsMask<M> HS_INLINE M any(const DiscreteVec<L, M>& v) {
  return detail::fold([](M a, M b) { return M(a | b); }, v);
}
/// Where all components of v are true: a mask, unlike all(mask), which combines lanes. GLSL 8.6.
template <int L, class M>
requires detail::kIsMask<M> HS_INLINE M all(const DiscreteVec<L, M>& v) {
  return detail::fold([](M a, M b) { return M(a & b); }, v);
}

}  // namespace halfspace::HS_LANES
