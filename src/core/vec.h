// SPDX-License-Identifier: Apache-2.0
//
// vec2<R>, vec3<R> and vec4<R>: small vectors of float, double or lanes, which shaders compute with.
//
// Uniforms and vertex data use GLM's types (glm::vec3, glm::mat4 and so on), whose values are the same for all pixels. These
// convert to vec<R> implicitly, so operators and functions accept any mix of the two as long as one argument is a vec<R>:
// in.normal + light, dot(n, light), world_from_object * position. A vec<float> or vec<double> converts back to the GLM type with
// the same component type.
//
// All functions (dot, length, normalize, …) are found by argument-dependent lookup, from any namespace. Each has a fixed order of
// operations, so that results for float and for lanes are bit-identical. The dot product of three components rounds once per component.
// GLM's does not, so the last bits of the two may differ.
//
// An expression of two uniforms is a uniform and is computed once, by GLM. The product of a uniform vector and a varying scalar
// is a vec3<R> for lanes but a glm::vec3 for float. Store it in a vec3<R> before passing it to dot, length, normalize or reflect.
#pragma once

#ifdef GLM_FORCE_DEFAULT_ALIGNED_GENTYPES
#error "Halfspace needs GLM's packed vectors (a glm::vec3 of 12 bytes): do not define GLM_FORCE_DEFAULT_ALIGNED_GENTYPES"
#endif

#include <concepts>
#include <glm/glm.hpp>

#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

template <int L, Number R>
struct VecN;
template <class R>
using vec2 = VecN<2, R>;
template <class R>
using vec3 = VecN<3, R>;
template <class R>
using vec4 = VecN<4, R>;

/// A matrix with C columns and L rows (glsl_matrix.h).
template <int C, int L, Number R>
struct MatN;

/// S converts to R without loss: a vector of S converts to a vector of R implicitly.
template <class S, class R>
concept WidensTo = std::same_as<S, float> ||(std::same_as<S, double>&& std::same_as<R, double>);
/// S converts to R, possibly with loss: a vector of S converts to a vector of R at least explicitly.
template <class S, class R>
concept CastsTo = WidensTo<S, R> ||(std::same_as<S, double>&& std::same_as<R, float>);

template <Number R>
struct VecN<2, R> {
  using value_type = R;
  R x, y;

  VecN() = default;
  HS_INLINE constexpr explicit VecN(R s) : x(s), y(s) {}
  HS_INLINE constexpr VecN(R a, R b) : x(a), y(b) {}
  HS_INLINE constexpr explicit VecN(const VecN<3, R>& v) : x(v.x), y(v.y) {}
  HS_INLINE constexpr explicit VecN(const VecN<4, R>& v) : x(v.x), y(v.y) {}
  template <CastsTo<R> S>
  HS_INLINE constexpr explicit(!WidensTo<S, R>) VecN(const VecN<2, S>& v) : x(static_cast<R>(v.x)), y(static_cast<R>(v.y)) {}
  template <CastsTo<R> S>
  HS_INLINE constexpr explicit(!WidensTo<S, R>) VecN(const glm::vec<2, S>& v) : x(static_cast<R>(v.x)), y(static_cast<R>(v.y)) {}
  template <class S>
  requires(!kIsLanes<R>) HS_INLINE constexpr explicit(!std::same_as<S, R>) operator glm::vec<2, S>() const {
    return glm::vec<2, S>(glm::vec<2, R>(x, y));
  }

  HS_INLINE constexpr R& operator[](int i) { return i == 0 ? x : y; }
  HS_INLINE constexpr const R& operator[](int i) const { return i == 0 ? x : y; }

  friend HS_INLINE constexpr VecN operator-(const VecN& a) { return {-a.x, -a.y}; }
  friend HS_INLINE constexpr VecN operator+(const VecN& a, const VecN& b) { return {a.x + b.x, a.y + b.y}; }
  friend HS_INLINE constexpr VecN operator-(const VecN& a, const VecN& b) { return {a.x - b.x, a.y - b.y}; }
  friend HS_INLINE constexpr VecN operator*(const VecN& a, const VecN& b) { return {a.x * b.x, a.y * b.y}; }
  friend HS_INLINE constexpr VecN operator/(const VecN& a, const VecN& b) { return {a.x / b.x, a.y / b.y}; }
  friend HS_INLINE constexpr VecN operator*(const VecN& a, R s) { return {a.x * s, a.y * s}; }
  friend HS_INLINE constexpr VecN operator*(R s, const VecN& a) { return {s * a.x, s * a.y}; }
  friend HS_INLINE constexpr VecN operator/(const VecN& a, R s) { return {a.x / s, a.y / s}; }
  HS_INLINE constexpr VecN& operator+=(const VecN& b) { return *this = *this + b; }
  HS_INLINE constexpr VecN& operator-=(const VecN& b) { return *this = *this - b; }
  HS_INLINE constexpr VecN& operator*=(const VecN& b) { return *this = *this * b; }
  HS_INLINE constexpr VecN& operator*=(R s) { return *this = *this * s; }
  HS_INLINE constexpr VecN& operator/=(R s) { return *this = *this / s; }
  friend HS_INLINE constexpr MaskOf<R> operator==(const VecN& a, const VecN& b) { return a.x == b.x && a.y == b.y; }
  friend HS_INLINE constexpr MaskOf<R> operator!=(const VecN& a, const VecN& b) { return !(a == b); }

  friend HS_INLINE R dot(const VecN& a, const VecN& b) { return a.x * b.x + a.y * b.y; }
  friend HS_INLINE R length(const VecN& a) { return sqrt(dot(a, a)); }
  friend HS_INLINE VecN normalize(const VecN& a) { return a * (R(1) / sqrt(dot(a, a))); }
  friend HS_INLINE VecN mix(const VecN& a, const VecN& b, R t) { return a * (R(1) - t) + b * t; }
  friend HS_INLINE VecN reflect(const VecN& v, const VecN& n) { return v - n * dot(n, v) * R(2); }
};

template <Number R>
struct VecN<3, R> {
  using value_type = R;
  R x, y, z;

  VecN() = default;
  HS_INLINE constexpr explicit VecN(R s) : x(s), y(s), z(s) {}
  HS_INLINE constexpr VecN(R a, R b, R c) : x(a), y(b), z(c) {}
  HS_INLINE constexpr VecN(const VecN<2, R>& ab, R c) : x(ab.x), y(ab.y), z(c) {}
  HS_INLINE constexpr explicit VecN(const VecN<4, R>& v) : x(v.x), y(v.y), z(v.z) {}
  template <CastsTo<R> S>
  HS_INLINE constexpr explicit(!WidensTo<S, R>) VecN(const VecN<3, S>& v)
      : x(static_cast<R>(v.x)), y(static_cast<R>(v.y)), z(static_cast<R>(v.z)) {}
  template <CastsTo<R> S>
  HS_INLINE constexpr explicit(!WidensTo<S, R>) VecN(const glm::vec<3, S>& v)
      : x(static_cast<R>(v.x)), y(static_cast<R>(v.y)), z(static_cast<R>(v.z)) {}
  template <class S>
  requires(!kIsLanes<R>) HS_INLINE constexpr explicit(!std::same_as<S, R>) operator glm::vec<3, S>() const {
    return glm::vec<3, S>(glm::vec<3, R>(x, y, z));
  }

  HS_INLINE constexpr R& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  HS_INLINE constexpr const R& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }

  friend HS_INLINE constexpr VecN operator-(const VecN& a) { return {-a.x, -a.y, -a.z}; }
  friend HS_INLINE constexpr VecN operator+(const VecN& a, const VecN& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend HS_INLINE constexpr VecN operator-(const VecN& a, const VecN& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend HS_INLINE constexpr VecN operator*(const VecN& a, const VecN& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend HS_INLINE constexpr VecN operator/(const VecN& a, const VecN& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
  friend HS_INLINE constexpr VecN operator*(const VecN& a, R s) { return {a.x * s, a.y * s, a.z * s}; }
  friend HS_INLINE constexpr VecN operator*(R s, const VecN& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend HS_INLINE constexpr VecN operator/(const VecN& a, R s) { return {a.x / s, a.y / s, a.z / s}; }
  HS_INLINE constexpr VecN& operator+=(const VecN& b) { return *this = *this + b; }
  HS_INLINE constexpr VecN& operator-=(const VecN& b) { return *this = *this - b; }
  HS_INLINE constexpr VecN& operator*=(const VecN& b) { return *this = *this * b; }
  HS_INLINE constexpr VecN& operator*=(R s) { return *this = *this * s; }
  HS_INLINE constexpr VecN& operator/=(R s) { return *this = *this / s; }
  friend HS_INLINE constexpr MaskOf<R> operator==(const VecN& a, const VecN& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
  friend HS_INLINE constexpr MaskOf<R> operator!=(const VecN& a, const VecN& b) { return !(a == b); }

  /// Rounds once per component for float and lanes. For double it is the plain sum of products.
  friend HS_INLINE R dot(const VecN& a, const VecN& b) {
    if constexpr (std::same_as<R, double>) {
      return a.x * b.x + a.y * b.y + a.z * b.z;
    } else {
      return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x));
    }
  }
  friend HS_INLINE R length(const VecN& a) { return sqrt(dot(a, a)); }
  friend HS_INLINE VecN normalize(const VecN& a) { return a * (R(1) / sqrt(dot(a, a))); }
  friend HS_INLINE VecN cross(const VecN& a, const VecN& b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
  }
  friend HS_INLINE VecN mix(const VecN& a, const VecN& b, R t) { return a * (R(1) - t) + b * t; }
  /// Reflects v at a plane with the unit normal n.
  friend HS_INLINE VecN reflect(const VecN& v, const VecN& n) { return v - n * dot(n, v) * R(2); }
};

template <Number R>
struct VecN<4, R> {
  using value_type = R;
  R x, y, z, w;

  VecN() = default;
  HS_INLINE constexpr explicit VecN(R s) : x(s), y(s), z(s), w(s) {}
  HS_INLINE constexpr VecN(R a, R b, R c, R d) : x(a), y(b), z(c), w(d) {}
  HS_INLINE constexpr VecN(const VecN<2, R>& ab, R c, R d) : x(ab.x), y(ab.y), z(c), w(d) {}
  HS_INLINE constexpr VecN(const VecN<2, R>& ab, const VecN<2, R>& cd) : x(ab.x), y(ab.y), z(cd.x), w(cd.y) {}
  HS_INLINE constexpr VecN(const VecN<3, R>& abc, R d) : x(abc.x), y(abc.y), z(abc.z), w(d) {}
  template <CastsTo<R> S>
  HS_INLINE constexpr explicit(!WidensTo<S, R>) VecN(const VecN<4, S>& v)
      : x(static_cast<R>(v.x)), y(static_cast<R>(v.y)), z(static_cast<R>(v.z)), w(static_cast<R>(v.w)) {}
  template <CastsTo<R> S>
  HS_INLINE constexpr explicit(!WidensTo<S, R>) VecN(const glm::vec<4, S>& v)
      : x(static_cast<R>(v.x)), y(static_cast<R>(v.y)), z(static_cast<R>(v.z)), w(static_cast<R>(v.w)) {}
  template <class S>
  requires(!kIsLanes<R>) HS_INLINE constexpr explicit(!std::same_as<S, R>) operator glm::vec<4, S>() const {
    return glm::vec<4, S>(glm::vec<4, R>(x, y, z, w));
  }

  HS_INLINE constexpr R& operator[](int i) { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
  HS_INLINE constexpr const R& operator[](int i) const { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }

  friend HS_INLINE constexpr VecN operator-(const VecN& a) { return {-a.x, -a.y, -a.z, -a.w}; }
  friend HS_INLINE constexpr VecN operator+(const VecN& a, const VecN& b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
  friend HS_INLINE constexpr VecN operator-(const VecN& a, const VecN& b) { return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w}; }
  friend HS_INLINE constexpr VecN operator*(const VecN& a, const VecN& b) { return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w}; }
  friend HS_INLINE constexpr VecN operator/(const VecN& a, const VecN& b) { return {a.x / b.x, a.y / b.y, a.z / b.z, a.w / b.w}; }
  friend HS_INLINE constexpr VecN operator*(const VecN& a, R s) { return {a.x * s, a.y * s, a.z * s, a.w * s}; }
  friend HS_INLINE constexpr VecN operator*(R s, const VecN& a) { return {s * a.x, s * a.y, s * a.z, s * a.w}; }
  friend HS_INLINE constexpr VecN operator/(const VecN& a, R s) { return {a.x / s, a.y / s, a.z / s, a.w / s}; }
  HS_INLINE constexpr VecN& operator+=(const VecN& b) { return *this = *this + b; }
  HS_INLINE constexpr VecN& operator-=(const VecN& b) { return *this = *this - b; }
  HS_INLINE constexpr VecN& operator*=(const VecN& b) { return *this = *this * b; }
  HS_INLINE constexpr VecN& operator*=(R s) { return *this = *this * s; }
  HS_INLINE constexpr VecN& operator/=(R s) { return *this = *this / s; }
  friend HS_INLINE constexpr MaskOf<R> operator==(const VecN& a, const VecN& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
  }
  friend HS_INLINE constexpr MaskOf<R> operator!=(const VecN& a, const VecN& b) { return !(a == b); }

  friend HS_INLINE R dot(const VecN& a, const VecN& b) { return (a.x * b.x + a.y * b.y) + (a.z * b.z + a.w * b.w); }
  friend HS_INLINE R length(const VecN& a) { return sqrt(dot(a, a)); }
  friend HS_INLINE VecN normalize(const VecN& a) { return a * (R(1) / sqrt(dot(a, a))); }
  friend HS_INLINE VecN mix(const VecN& a, const VecN& b, R t) { return a * (R(1) - t) + b * t; }
  friend HS_INLINE VecN reflect(const VecN& v, const VecN& n) { return v - n * dot(n, v) * R(2); }
};

// ---- vector and scalar -----------------------------------------------------------------------------------------

template <int L, Number R>
HS_INLINE constexpr VecN<L, R> operator+(const VecN<L, R>& v, std::type_identity_t<R> s) {
  return v + VecN<L, R>(s);
}
template <int L, Number R>
HS_INLINE constexpr VecN<L, R> operator+(std::type_identity_t<R> s, const VecN<L, R>& v) {
  return VecN<L, R>(s) + v;
}
template <int L, Number R>
HS_INLINE constexpr VecN<L, R> operator-(const VecN<L, R>& v, std::type_identity_t<R> s) {
  return v - VecN<L, R>(s);
}
template <int L, Number R>
HS_INLINE constexpr VecN<L, R> operator-(std::type_identity_t<R> s, const VecN<L, R>& v) {
  return VecN<L, R>(s) - v;
}
template <int L, Number R>
HS_INLINE constexpr VecN<L, R> operator/(std::type_identity_t<R> s, const VecN<L, R>& v) {
  return VecN<L, R>(s) / v;
}
template <int L, Number R>
HS_INLINE constexpr VecN<L, R>& operator+=(VecN<L, R>& v, std::type_identity_t<R> s) {
  return v = v + s;
}
template <int L, Number R>
HS_INLINE constexpr VecN<L, R>& operator-=(VecN<L, R>& v, std::type_identity_t<R> s) {
  return v = v - s;
}
/// Divides component by component.
template <int L, Number R>
HS_INLINE constexpr VecN<L, R>& operator/=(VecN<L, R>& v, const VecN<L, R>& w) {
  return v = v / w;
}
// ---- uniform and varying ---------------------------------------------------------------------------------------

/// Number types whose product with a uniform vector is not defined by GLM.
template <class R>
concept MixesWithFloat = Number<R> && !std::same_as<R, float>;

template <int L, MixesWithFloat R>
HS_INLINE VecN<L, R> operator*(const glm::vec<L, float>& a, R s) {
  return VecN<L, R>(a) * s;
}
template <int L, MixesWithFloat R>
HS_INLINE VecN<L, R> operator*(R s, const glm::vec<L, float>& a) {
  return s * VecN<L, R>(a);
}
template <int L, MixesWithFloat R>
HS_INLINE VecN<L, R> mix(const glm::vec<L, float>& a, const glm::vec<L, float>& b, R t) {
  return mix(VecN<L, R>(a), VecN<L, R>(b), t);
}

template <Number R, WidensTo<R> S>
HS_INLINE vec3<R> operator*(const glm::mat<3, 3, S>& m, const vec3<R>& v) {
  return m[0] * v.x + m[1] * v.y + m[2] * v.z;
}
template <Number R, WidensTo<R> S>
HS_INLINE vec4<R> operator*(const glm::mat<4, 4, S>& m, const vec4<R>& v) {
  const vec4<R> xy = m[0] * v.x + m[1] * v.y, zw = m[2] * v.z + m[3] * v.w;
  return xy + zw;
}

/// Selects a where m is true and b elsewhere, lane by lane.
template <int L, Number R>
HS_INLINE VecN<L, R> select(MaskOf<R> m, const VecN<L, R>& a, const VecN<L, R>& b) {
  VecN<L, R> r;
  for (int i = 0; i < L; ++i) r[i] = select(m, a[i], b[i]);
  return r;
}

/// Returns v divided by its length, or zero if v is zero. No intermediate result overflows or underflows, for any length of v.
glm::dvec3 unit_or_zero(const glm::dvec3& v);

}  // namespace halfspace::HS_LANES
