// SPDX-License-Identifier: Apache-2.0
//
// Compile-time reflection for plain structs: field_count<T>() counts the members and tie_fields(t) returns references to them, so that
// shader attributes and varyings need no registration. T must be an aggregate with at most 12 members, and no member may be an array.
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

namespace detail {

// Converts to any type. T{AnyField, AnyField} compiles only if T has at least that many members.
struct AnyField {
  template <class T>
  operator T() const;
};

template <class T, std::size_t... I>
constexpr bool has_fields(std::index_sequence<I...>) {
  return requires { T{((void)I, AnyField{})...}; };
}

template <class T, std::size_t N>
constexpr std::size_t count_fields() {
  if constexpr (has_fields<T>(std::make_index_sequence<N>{})) {
    return N;
  } else {
    return count_fields<T, N - 1>();
  }
}

}  // namespace detail

inline constexpr std::size_t kMaxFields = 12;

/// Returns the number of members of the aggregate T.
template <class T>
constexpr std::size_t field_count() {
  static_assert(std::is_aggregate_v<T>, "attributes and varyings must be plain structs without constructors");
  static_assert(!detail::has_fields<T>(std::make_index_sequence<kMaxFields + 1>{}),
                "a struct of attributes or varyings must not have more than 12 members");
  return detail::count_fields<T, kMaxFields>();
}

/// Returns a tuple of references to the members of t, in declaration order.
template <class T>
HS_INLINE constexpr auto tie_fields(T& t) {
  constexpr std::size_t n = field_count<std::remove_const_t<T>>();
  if constexpr (n == 0) {
    return std::tie();
  } else if constexpr (n == 1) {
    auto& [a] = t;
    return std::tie(a);
  } else if constexpr (n == 2) {
    auto& [a, b] = t;
    return std::tie(a, b);
  } else if constexpr (n == 3) {
    auto& [a, b, c] = t;
    return std::tie(a, b, c);
  } else if constexpr (n == 4) {
    auto& [a, b, c, d] = t;
    return std::tie(a, b, c, d);
  } else if constexpr (n == 5) {
    auto& [a, b, c, d, e] = t;
    return std::tie(a, b, c, d, e);
  } else if constexpr (n == 6) {
    auto& [a, b, c, d, e, f] = t;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (n == 7) {
    auto& [a, b, c, d, e, f, g] = t;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (n == 8) {
    auto& [a, b, c, d, e, f, g, h] = t;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (n == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = t;
    return std::tie(a, b, c, d, e, f, g, h, i);
  } else if constexpr (n == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (n == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k);
  } else {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = t;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
  }
}

}  // namespace halfspace::HS_LANES
