// SPDX-License-Identifier: Apache-2.0
//
// Swizzles: several components of a vector at once, in any order, as in GLSL.
//
//   GLSL                    here
//   v.zyx                   swizzle<"zyx">(v)
//   v.rgb, v.st             swizzle<"rgb">(v), swizzle<"st">(v)
//   v.xy = a;               swizzle_ref<"xy">(v) = a;
//   v.xz *= 2.0;            swizzle_ref<"xz">(v) *= 2.0f;
//
// The names are a string that is checked when the code is compiled. Members such as v.zyx() would need a macro or up to 340 functions for
// each length, and assignable members, as GLM has them, would need a union of up to 340 proxies, which makes every vector as hard to
// optimize as the worst of its uses. Reading returns a vector and writing a reference, with different names: a proxy that does both is
// deduced as a proxy where a function expects a vector.
#pragma once

#include "halfspace/core/discrete_vec.h"

namespace halfspace::HS_LANES {

namespace detail {

/// The names of the components of a swizzle, which all come from one of the sets xyzw, rgba and stpq.
template <std::size_t N>
struct ComponentNames {
  char letters[N];

  consteval ComponentNames(const char (&names)[N]) {
    for (std::size_t i = 0; i < N; ++i) letters[i] = names[i];
  }
  static constexpr int size() { return static_cast<int>(N) - 1; }
  /// The number of the component that letter i names, or 4 for none.
  constexpr int index(int i) const {
    for (const char* set : {"xyzw", "rgba", "stpq"}) {
      if (index_in(set, letters[0]) == 4) continue;
      return index_in(set, letters[i]);
    }
    return 4;
  }
  constexpr bool name_components_of(int length) const {
    for (int i = 0; i < size(); ++i) {
      if (index(i) >= length) return false;
    }
    return size() >= 1 && size() <= 4;
  }
  constexpr bool are_distinct() const {
    for (int i = 0; i < size(); ++i) {
      for (int k = 0; k < i; ++k) {
        if (index(i) == index(k)) return false;
      }
    }
    return true;
  }

 private:
  static constexpr int index_in(const char* set, char letter) {
    int i = 0;
    while (i < 4 && set[i] != letter) ++i;
    return i;
  }
};

}  // namespace detail

/// Returns the named components of v: one of them as a scalar, more of them as a vector. swizzle<"zyx">(v) is v.zyx of GLSL.
template <detail::ComponentNames names, class V>
requires detail::kHasVector<V> HS_INLINE auto swizzle(const V& v) {
  static_assert(names.name_components_of(detail::kLengthOf<V>),
                "a swizzle names one to four components of the vector, all from one of the sets xyzw, rgba and stpq");
  if constexpr (names.size() == 1) {
    return v[names.index(0)];
  } else {
    return [&]<int... I>(std::integer_sequence<int, I...>) {
      return detail::VectorOf<names.size(), detail::ComponentOf<V>>(v[names.index(I)]...);
    }
    (std::make_integer_sequence<int, names.size()>());
  }
}

namespace detail {

/// Some components of a vector, to be written.
template <ComponentNames names, class V>
class SwizzleRef {
 public:
  using Value = VectorOf<names.size() == 1 ? 0 : names.size(), ComponentOf<V>>;

  HS_INLINE explicit SwizzleRef(V& v) : v_(v) {}
  SwizzleRef(const SwizzleRef&) = delete;
  SwizzleRef& operator=(const SwizzleRef&) = delete;

  // By value, because the value may be the vector itself.
  HS_INLINE void operator=(Value value) const {
    for (int i = 0; i < names.size(); ++i) {
      if constexpr (names.size() == 1) {
        v_[names.index(i)] = value;
      } else {
        v_[names.index(i)] = value[i];
      }
    }
  }
  template <class B>
  HS_INLINE void operator+=(const B& b) const {
    *this = swizzle<names>(v_) + b;
  }
  template <class B>
  HS_INLINE void operator-=(const B& b) const {
    *this = swizzle<names>(v_) - b;
  }
  template <class B>
  HS_INLINE void operator*=(const B& b) const {
    *this = swizzle<names>(v_) * b;
  }
  template <class B>
  HS_INLINE void operator/=(const B& b) const {
    *this = swizzle<names>(v_) / b;
  }

 private:
  V& v_;
};

}  // namespace detail

/// The named components of v, to be assigned to: swizzle_ref<"xy">(v) = a is v.xy = a of GLSL. No component may be named twice.
template <detail::ComponentNames names, class V>
requires detail::kHasVector<V> HS_INLINE auto swizzle_ref(V& v) {
  static_assert(names.name_components_of(detail::kLengthOf<V>),
                "a swizzle names one to four components of the vector, all from one of the sets xyzw, rgba and stpq");
  static_assert(names.are_distinct(), "a swizzle that is written must not name a component twice");
  return detail::SwizzleRef<names, V>(v);
}

}  // namespace halfspace::HS_LANES
