// SPDX-License-Identifier: Apache-2.0
//
// Functions for tables with one row per enumerator (shapes.cpp, lights.cpp). Each row has a name and lists its keys that some other rows
// lack.
#pragma once

#include <algorithm>
#include <array>
#include <list>
#include <string>
#include <string_view>

#include "halfspace/core/text.h"

namespace halfspace::HS_LANES {

/// Returns true if row i describes enumerator i for every i, so that enumerators can index the table. value: the member that holds the
/// enumerator.
template <class Kind, std::size_t n, class Value>
constexpr bool is_in_order(const Kind (&kinds)[n], Value Kind::*value) {
  for (std::size_t i = 0; i < n; ++i) {
    if (kinds[i].*value != static_cast<Value>(i)) return false;
  }
  return true;
}

/// Returns the names of the rows.
template <class Kind, std::size_t n>
constexpr std::array<std::string_view, n> names_of(const Kind (&kinds)[n]) {
  std::array<std::string_view, n> names{};
  std::ranges::transform(kinds, names.begin(), &Kind::name);
  return names;
}

/// Returns the names of the rows that have a key, separated by spaces. The string lives until the program ends.
template <class Kind, std::size_t n>
const char* names_with(const Kind (&kinds)[n], std::string_view key) {
  static std::list<std::string> lists;
  std::string& list = lists.emplace_back();
  for (const Kind& kind : kinds) {
    if (!has_word(kind.keys, key)) continue;
    if (!list.empty()) list += ' ';
    list += kind.name;
  }
  return list.c_str();
}

}  // namespace halfspace::HS_LANES
