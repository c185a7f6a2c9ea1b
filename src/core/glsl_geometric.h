// SPDX-License-Identifier: Apache-2.0
//
// The geometric functions of GLSL 3.30, section 8.4. length, dot, cross, normalize and reflect of vectors are in vec.h. Of scalars, they do
// what they do to vectors with one component.
#pragma once

#include "halfspace/core/component_wise.h"

namespace halfspace::HS_LANES {

namespace detail {
/// Arguments of a geometric function: vectors or numbers of one length.
template <class... A>
concept OfOneLength = NumberArguments<A...> &&((kLengthOf<A> == kCommonLength<A...>)&&...);
/// Converts an argument to the type that the function returns.
template <class V, class A>
HS_INLINE V as_vector(const A& a) {
  if constexpr (kLengthOf<V> == 0) {
    return cast<V>(a);
  } else {
    return V(a);
  }
}
template <class... A>
using CommonVector = VectorOf<kCommonLength<A...>, NumberOf<A...>>;
}  // namespace detail

/// Returns |x|, exact. GLSL 8.4.
template <Number R>
HS_INLINE R length(R x) {
  return abs(x);
}
/// Returns x·y, correctly rounded. GLSL 8.4.
template <Number R>
HS_INLINE R dot(R x, std::type_identity_t<R> y) {
  return x * y;
}
/// Returns the sign of x: 1 or −1, and NaN for 0, as for vectors. GLSL 8.4.
template <Number R>
HS_INLINE R normalize(R x) {
  return select(x > R(0), R(1), select(x < R(0), R(-1), x / abs(x)));
}
/// Returns v − 2·dot(n, v)·n, evaluated as for vectors. GLSL 8.4.
template <Number R>
HS_INLINE R reflect(R v, std::type_identity_t<R> n) {
  return v - n * (n * v) * R(2);
}

/// Returns length(a − b), with the roundings of these. GLSL 8.4.
template <class A, class B>
requires detail::OfOneLength<A, B> HS_INLINE auto distance(const A& a, const B& b) {
  using V = detail::CommonVector<A, B>;
  return length(detail::as_vector<V>(a) - detail::as_vector<V>(b));
}
/// Returns n where dot(reference, incident) < 0, and −n elsewhere. GLSL 8.4.
template <class N, class I, class Ref>
requires detail::OfOneLength<N, I, Ref> HS_INLINE auto faceforward(const N& n, const I& incident, const Ref& reference) {
  using V = detail::CommonVector<N, I, Ref>;
  const V normal = detail::as_vector<V>(n);
  using R = detail::ComponentOf<V>;
  return select(dot(detail::as_vector<V>(reference), detail::as_vector<V>(incident)) < R(0), normal, -normal);
}
/// Refracts the unit vector `incident` at a plane with the unit normal n: eta·incident − (eta·d + sqrt(k))·n, where d = dot(n, incident)
/// and k = 1 − eta²·(1 − d²). Total reflection (k < 0) gives 0. Rounds after every operation. GLSL 8.4.
template <class I, class N, class Eta>
requires detail::OfOneLength<I, N> && detail::NumberArguments<I, N, Eta> &&(detail::kLengthOf<Eta> == 0)  //
    HS_INLINE auto refract(const I& incident, const N& n, const Eta& eta) {
  using R = detail::NumberOf<I, N, Eta>;
  using V = detail::VectorOf<detail::kLengthOf<I>, R>;
  const V direction = detail::as_vector<V>(incident), normal = detail::as_vector<V>(n);
  const R ratio = detail::cast<R>(eta), d = dot(normal, direction);
  const R k = R(1) - ratio * ratio * (R(1) - d * d);
  const V refracted = direction * ratio - normal * (ratio * d + sqrt(max(k, R(0))));
  return select(k < R(0), V(R(0)), refracted);
}

}  // namespace halfspace::HS_LANES
