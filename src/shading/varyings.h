// SPDX-License-Identifier: Apache-2.0
//
// What a shader's Attributes, Varyings and Primitive structs are to the pipeline: a row of components of type R, and
// for varyings how each component is interpolated. Found from the member types alone; a shader registers nothing.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

#include "halfspace/core/aggregate_reflection.h"
#include "halfspace/core/vec.h"

namespace halfspace {

/// A varying that keeps the provoking vertex's value over the whole triangle (GLSL: flat).
template <class T>
struct Flat {
  T value;
};

/// A varying interpolated linearly in window space (GLSL: noperspective).
template <class T>
struct NoPerspective {
  T value;
};

/// A member that is not there: no components and, declared [[no_unique_address]], no room. Two in one struct need different tags.
template <int tag>
struct Absent {};
/// T, or a member that is not there: for a shader whose variants carry different things.
template <bool present, class T, int tag>
using MemberIf = std::conditional_t<present, T, Absent<tag>>;

/// A smooth varying that is looked up inside of the triangle where it covers a pixel in part and the pixel is shaded once for
/// several samples: at the first covered sample instead of the centre (GLSL: centroid).
template <class T>
struct Centroid {
  T value;
};

enum class Interpolation : uint8_t { smooth, flat, linear, centroid };

namespace detail {

template <class T>
struct FieldTraits;
template <Number R>
struct FieldTraits<R> {
  static constexpr std::size_t components = 1;
  static constexpr Interpolation interpolation = Interpolation::smooth;
};
template <int L, Number R>
struct FieldTraits<VecN<L, R>> {
  static constexpr std::size_t components = static_cast<std::size_t>(L);
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
};

}  // namespace detail

/// How many components (values of R) the struct T holds.
template <class T>
inline constexpr std::size_t kComponents = detail::TupleTraits<detail::FieldsOf<T>>::components;

/// How each component of the varyings V is interpolated.
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

// One by one where they are large: gcc makes a single copy of 896 bytes (seven components of two packets) a call of memcpy, with all that
// is in registers put aside. Up to 640 bytes it does not, and a single copy is the faster one.
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

/// Is one of them looked up at the centroid?
template <class V>
inline constexpr bool kUsesCentroid = detail::kAny<V, Interpolation::centroid>;
/// Is one of them linear in the window?
template <class V>
inline constexpr bool kUsesNoPerspective = detail::kAny<V, Interpolation::linear>;

/// The components of t as an array of R, in order of declaration.
template <class R, class T>
HS_INLINE std::array<R, kComponents<T>> to_components(const T& t) {
  std::array<R, kComponents<T>> a;
  if constexpr (kComponents<T> != 0) {
    static_assert(sizeof(T) == sizeof(a),
                  "the members of attributes and varyings are R, vec2<R>, vec3<R>, vec4<R>, Flat, Linear or Centroid of these");
    detail::copy_components(reinterpret_cast<const R*>(&t), a.data(), std::make_index_sequence<kComponents<T>>());
  }
  return a;
}

/// The struct whose components are a.
template <class T, class R>
HS_INLINE T from_components(const std::array<R, kComponents<T>>& a) {
  T t;
  if constexpr (kComponents<T> != 0) {
    static_assert(sizeof(T) == sizeof(a));
    detail::copy_components(a.data(), reinterpret_cast<R*>(&t), std::make_index_sequence<kComponents<T>>());
  }
  return t;
}

}  // namespace halfspace
