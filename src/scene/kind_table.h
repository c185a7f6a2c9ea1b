// SPDX-License-Identifier: Apache-2.0
//
// Functions of tables with one row per value of an enumeration (shapes.cpp, lights.cpp). Each row has a name, and a list of the keys that
// only some rows have.
#pragma once

#include <algorithm>
#include <array>
#include <list>
#include <string>
#include <string_view>

#include "halfspace/core/text.h"

namespace halfspace {

/// Returns true if row i is that of value i, so that a row can be looked up by its value. value: the member with the value.
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

}  // namespace halfspace
