// SPDX-License-Identifier: Apache-2.0
//
// Vectors of GLM over float, double or lanes, and what GLM does not give for them: operators that mix a uniform
// (float, glm::vec, glm::mat: the same for all pixels) with a varying (R, vec<R>: one value a pixel).
//
// With R = float a uniform and a varying are one type and GLM's own operators apply; those below repeat GLM's order
// of operations, so that float and lanes give the same bits.
#pragma once

#include "halfspace/core/lanes.h"

// Before GLM: its vec of lanes must find the scalar functions above by their argument's namespace.
#include <glm/glm.hpp>

namespace halfspace {

template <class R>
using vec2 = glm::vec<2, R>;
template <class R>
using vec3 = glm::vec<3, R>;
template <class R>
using vec4 = glm::vec<4, R>;

/// A number type that differs from float, so that mixing it with uniforms needs the operators below.
template <class R>
concept MixesWithFloat = kIsLanes<R> || std::is_same_v<R, double>;

}  // namespace halfspace

namespace glm {

template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> widen(const vec<L, float>& v) {
  vec<L, R> r;
  for (length_t i = 0; i < L; ++i) r[i] = R(v[i]);
  return r;
}

// varying op uniform, both ways round
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator+(const vec<L, R>& a, const vec<L, float>& b) {
  return a + widen<L, R>(b);
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator+(const vec<L, float>& a, const vec<L, R>& b) {
  return widen<L, R>(a) + b;
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator-(const vec<L, R>& a, const vec<L, float>& b) {
  return a - widen<L, R>(b);
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator-(const vec<L, float>& a, const vec<L, R>& b) {
  return widen<L, R>(a) - b;
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator*(const vec<L, R>& a, const vec<L, float>& b) {
  return a * widen<L, R>(b);
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator*(const vec<L, float>& a, const vec<L, R>& b) {
  return widen<L, R>(a) * b;
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator/(const vec<L, R>& a, const vec<L, float>& b) {
  return a / widen<L, R>(b);
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator*(const vec<L, R>& a, float b) {
  return a * R(b);
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator*(float a, const vec<L, R>& b) {
  return R(a) * b;
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator/(const vec<L, R>& a, float b) {
  return a / R(b);
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator*(const vec<L, float>& a, R b) {
  return widen<L, R>(a) * b;
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> operator*(R a, const vec<L, float>& b) {
  return a * widen<L, R>(b);
}
template <halfspace::MixesWithFloat R>
HS_INLINE vec<4, R> operator*(const mat<4, 4, float>& m, const vec<4, R>& v) {
  const vec<4, R> xy = widen<4, R>(m[0]) * v[0] + widen<4, R>(m[1]) * v[1];
  const vec<4, R> zw = widen<4, R>(m[2]) * v[2] + widen<4, R>(m[3]) * v[3];
  return xy + zw;
}
template <halfspace::MixesWithFloat R>
HS_INLINE vec<3, R> operator*(const mat<3, 3, float>& m, const vec<3, R>& v) {
  // GLM sums each row from left to right.
  return widen<3, R>(m[0]) * v[0] + widen<3, R>(m[1]) * v[1] + widen<3, R>(m[2]) * v[2];
}

/// With one rounding a component. (GLM's is taken for double alone.)
template <class R>
requires(halfspace::kIsLanes<R> || std::is_same_v<R, float>) HS_INLINE R dot(const vec<3, R>& a, const vec<3, R>& b) {
  using halfspace::fma;
  return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x));
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE R dot(const vec<L, R>& a, const vec<L, float>& b) {
  return dot(a, widen<L, R>(b));
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE R dot(const vec<L, float>& a, const vec<L, R>& b) {
  return dot(widen<L, R>(a), b);
}
template <length_t L, halfspace::MixesWithFloat R>
HS_INLINE vec<L, R> mix(const vec<L, float>& a, const vec<L, float>& b, R t) {
  return mix(widen<L, R>(a), widen<L, R>(b), vec<L, R>(t));
}

}  // namespace glm

namespace halfspace {

template <glm::length_t L, class R>
HS_INLINE glm::vec<L, R> select(MaskOf<R> m, const glm::vec<L, R>& a, const glm::vec<L, R>& b) {
  glm::vec<L, R> r;
  for (glm::length_t i = 0; i < L; ++i) r[i] = select(m, a[i], b[i]);
  return r;
}

/// v divided by its length. No intermediate overflows or underflows, whatever v's size; the zero vector stays zero.
glm::dvec3 unit_or_zero(const glm::dvec3& v);

}  // namespace halfspace
