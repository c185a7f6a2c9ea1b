// SPDX-License-Identifier: Apache-2.0
//
// The pipeline's view of a shader's Attributes, Varyings and Primitive structs: an array of components of type R and, for
// varyings, the interpolation mode of each. Both are derived from the member types, so shaders do not have to register anything.
//
// A member is an R, vec2<R>, vec3<R>, vec4<R>, a matrix mat2<R> to mat4<R>, an integer IntOf<R>, or a std::array of these. Among the
// components, an integer is an R with its bits; only for R = double, which is wider, it is an R with its value. Integers are not
// interpolated, so a varying with integers must be Flat. Unsigned integers are IntOf<R> with the same bits.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <utility>

#include "halfspace/core/aggregate_reflection.h"
#include "halfspace/core/vec.h"

namespace halfspace::HS_LANES {

/// A varying with the value of the provoking vertex on the whole triangle (flat in GLSL).
template <class T>
struct Flat {
  T value;
};

/// A varying interpolated linearly in window space (noperspective in GLSL).
template <class T>
struct NoPerspective {
  T value;
};

/// An absent member. It has no components and, if declared [[no_unique_address]], no size. Absent members of the same struct need
/// different tags.
template <int tag>
struct Absent {};
/// T, or an absent member. Used by shaders whose variants have different members.
template <bool present, class T, int tag>
using MemberIf = std::conditional_t<present, T, Absent<tag>>;

/// A smooth varying that is evaluated inside the triangle (centroid in GLSL). If a pixel is partially covered and shaded once for several
/// samples, the varying is evaluated at the first covered sample instead of the pixel center.
template <class T>
struct Centroid {
  T value;
};

/// A smooth varying that is evaluated at each sample (sample in GLSL). The fragment function then runs once per sample, as with
/// DrawState::sample_shading.
template <class T>
struct PerSample {
  T value;
};

enum class Interpolation : uint8_t { smooth, flat, linear, centroid, sample };

namespace detail {

template <class T>
struct FieldTraits;
template <Number R>
struct FieldTraits<R> {
  static constexpr std::size_t components = 1;
  static constexpr Interpolation interpolation = Interpolation::smooth;
};
template <class I>
requires kIsIntLanes<I>
struct FieldTraits<I> {
  static constexpr std::size_t components = 1;
  static constexpr Interpolation interpolation = Interpolation::smooth;
};
template <int L, Number R>
struct FieldTraits<VecN<L, R>> {
  static constexpr std::size_t components = static_cast<std::size_t>(L);
  static constexpr Interpolation interpolation = Interpolation::smooth;
};
template <int C, int L, Number R>
struct FieldTraits<MatN<C, L, R>> {
  static constexpr std::size_t components = static_cast<std::size_t>(C) * L;
  static constexpr Interpolation interpolation = Interpolation::smooth;
};
template <class T>
struct FieldTraits<Flat<T>> : FieldTraits<T> {
  static constexpr Interpolation interpolation = Interpolation::flat;
};
template <class T>
struct FieldTraits<NoPerspective<T>> : FieldTraits<T> {
  static constexpr Interpolation interpolation = Interpolation::linear;
};

template <int tag>
struct FieldTraits<Absent<tag>> {
  static constexpr std::size_t components = 0;
  static constexpr Interpolation interpolation = Interpolation::flat;
};

template <class T>
struct FieldTraits<Centroid<T>> : FieldTraits<T> {
  static constexpr Interpolation interpolation = Interpolation::centroid;
};

template <class T>
struct FieldTraits<PerSample<T>> : FieldTraits<T> {
  static constexpr Interpolation interpolation = Interpolation::sample;
};

template <class T, std::size_t N>
struct FieldTraits<std::array<T, N>> : FieldTraits<T> {
  static constexpr std::size_t components = N * FieldTraits<T>::components;
};

/// Whether a member consists of integers.
template <class T>
inline constexpr bool kIntegerField = kIsIntLanes<T>;
template <class T>
inline constexpr bool kIntegerField<Flat<T>> = kIntegerField<T>;
template <class T>
inline constexpr bool kIntegerField<NoPerspective<T>> = kIntegerField<T>;
template <class T>
inline constexpr bool kIntegerField<Centroid<T>> = kIntegerField<T>;
template <class T>
inline constexpr bool kIntegerField<PerSample<T>> = kIntegerField<T>;
template <class T, std::size_t N>
inline constexpr bool kIntegerField<std::array<T, N>> = kIntegerField<T>;

/// Number of vectors that a member consists of: locations in GLSL. An array of numbers counts as one vector.
template <class T>
inline constexpr std::size_t kVectorsIn = FieldTraits<T>::components == 0 ? 0 : 1;
template <int C, int L, Number R>
inline constexpr std::size_t kVectorsIn<MatN<C, L, R>> = static_cast<std::size_t>(C);
template <class T, std::size_t N>
inline constexpr std::size_t kVectorsIn<std::array<T, N>> = FieldTraits<T>::components == 1 ? 1 : N* kVectorsIn<T>;

template <class T>
using FieldsOf = decltype(tie_fields(std::declval<T&>()));

template <class Tuple>
struct TupleTraits;
template <class... F>
struct TupleTraits<std::tuple<F&...>> {
  static constexpr std::size_t components = (std::size_t{0} + ... + FieldTraits<std::remove_const_t<F>>::components);
  static constexpr auto interpolations() {
    std::array<Interpolation, components> modes{};
    std::size_t i = 0;
    const auto add = [&](Interpolation mode, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) modes[i++] = mode;
    };
    (add(FieldTraits<std::remove_const_t<F>>::interpolation, FieldTraits<std::remove_const_t<F>>::components), ...);
    (void)add;
    return modes;
  }
  static constexpr bool has_integers = (kIntegerField<std::remove_const_t<F>> || ...);
  // Only flat members have components without interpolation.
  static constexpr bool interpolates_integers =
      ((kIntegerField<std::remove_const_t<F>> && FieldTraits<std::remove_const_t<F>>::interpolation != Interpolation::flat) || ...);
  static constexpr uint64_t integer_components() {
    uint64_t bits = 0;
    std::size_t i = 0;
    const auto add = [&](bool is_integer, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k, ++i) {
        if (is_integer && i < 64) bits |= uint64_t{1} << i;
      }
    };
    (add(kIntegerField<std::remove_const_t<F>>, FieldTraits<std::remove_const_t<F>>::components), ...);
    (void)add;
    return bits;
  }
};

}  // namespace detail

/// Number of components (values of type R) of the struct T.
template <class T>
inline constexpr std::size_t kComponents = detail::TupleTraits<detail::FieldsOf<T>>::components;

/// Largest number of components of Attributes and of Varyings (GL_MAX_VERTEX_ATTRIBS vectors, GL_MAX_VARYING_COMPONENTS).
inline constexpr std::size_t kMaxComponents = 64;

/// Whether any member of the struct T consists of integers.
template <class T>
inline constexpr bool kHasIntegers = detail::TupleTraits<detail::FieldsOf<T>>::has_integers;
/// Whether the varyings V have integers that are not flat.
template <class V>
inline constexpr bool kInterpolatesIntegers = detail::TupleTraits<detail::FieldsOf<V>>::interpolates_integers;
/// Bit i is set if component i of the struct T is an integer. T must have at most kMaxComponents components.
template <class T>
inline constexpr uint64_t kIntegerComponents = detail::TupleTraits<detail::FieldsOf<T>>::integer_components();

/// Interpolation mode of each component of the varyings V.
template <class V>
inline constexpr auto kInterpolations = detail::TupleTraits<detail::FieldsOf<V>>::interpolations();

namespace detail {
template <class V, Interpolation mode>
inline constexpr bool kAny = [] {
  for (const Interpolation i : kInterpolations<V>) {
    if (i == mode) return true;
  }
  return false;
}();

// Large structs are copied component by component. GCC compiles a single copy of 896 bytes (seven components of two packets) to a memcpy
// call, around which it spills all registers. For up to 640 bytes it does not, and a single copy is faster.
template <class R, std::size_t... I>
HS_INLINE void copy_components(const R* from, R* to, std::index_sequence<I...>) {
  constexpr std::size_t bytes = sizeof...(I) * sizeof(R);
  if constexpr (bytes <= 768) {
    std::memcpy(static_cast<void*>(to), from, bytes);
  } else {
    ((to[I] = from[I]), ...);
  }
}
}  // namespace detail

/// Whether any component is evaluated at the centroid.
template <class V>
inline constexpr bool kUsesCentroid = detail::kAny<V, Interpolation::centroid>;
/// Whether any component is evaluated at each sample.
template <class V>
inline constexpr bool kUsesPerSample = detail::kAny<V, Interpolation::sample>;
/// Whether any component is linear in window space.
template <class V>
inline constexpr bool kUsesNoPerspective = detail::kAny<V, Interpolation::linear>;

namespace detail {

/// Whether components of type R hold the values of the integers of T instead of their bits: R is wider than an integer.
template <class T, class R>
inline constexpr bool kConvertsIntegers = std::is_same_v<R, double>&& kHasIntegers<T>;

template <class T>
HS_INLINE void put_components(const T& member, double*& out) {
  using Element = std::conditional_t<kIntegerField<T>, int32_t, double>;
  std::array<Element, FieldTraits<T>::components> a;
  if constexpr (!a.empty()) std::memcpy(a.data(), &member, sizeof a);
  for (const Element e : a) *out++ = static_cast<double>(e);
}
template <class T>
HS_INLINE void take_components(const double*& from, T& member) {
  using Element = std::conditional_t<kIntegerField<T>, int32_t, double>;
  std::array<Element, FieldTraits<T>::components> a;
  for (Element& e : a) e = static_cast<Element>(*from++);
  if constexpr (!a.empty()) std::memcpy(static_cast<void*>(&member), a.data(), sizeof a);
}

}  // namespace detail

/// Returns the components of t as an array of R, in declaration order.
template <class R, class T>
HS_INLINE std::array<R, kComponents<T>> to_components(const T& t) {
  std::array<R, kComponents<T>> a;
  if constexpr (detail::kConvertsIntegers<T, R>) {
    double* out = a.data();
    std::apply([&](const auto&... member) { (detail::put_components(member, out), ...); }, tie_fields(t));
  } else if constexpr (kComponents<T> != 0) {
    static_assert(
        sizeof(T) == sizeof(a),
        "the members of attributes and varyings must be R, vec2<R>, vec3<R>, vec4<R>, mat2<R> … mat4<R>, IntOf<R>, a std::array of "
        "these, or Flat, NoPerspective, Centroid or PerSample of these");
    detail::copy_components(reinterpret_cast<const R*>(&t), a.data(), std::make_index_sequence<kComponents<T>>());
  }
  return a;
}

/// Returns the struct with the components a. The inverse of to_components.
template <class T, class R>
HS_INLINE T from_components(const std::array<R, kComponents<T>>& a) {
  T t;
  if constexpr (detail::kConvertsIntegers<T, R>) {
    const double* from = a.data();
    std::apply([&](auto&... member) { (detail::take_components(from, member), ...); }, tie_fields(t));
  } else if constexpr (kComponents<T> != 0) {
    static_assert(sizeof(T) == sizeof(a));
    detail::copy_components(a.data(), reinterpret_cast<R*>(&t), std::make_index_sequence<kComponents<T>>());
  }
  return t;
}

}  // namespace halfspace::HS_LANES
