// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/text/parse_number.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace halfspace::HS_LANES {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();

char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c; }

bool starts_with_word(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && std::ranges::equal(text.substr(0, word.size()), word, {}, lower_case);
}

bool is_alphanumeric(char c) { return (c >= '0' && c <= '9') || (lower_case(c) >= 'a' && lower_case(c) <= 'z'); }

// Returns infinity or NaN if the word, which has no sign, spells one of them in a form that std::from_chars does not know.
std::optional<double> not_finite(std::string_view word) {
  if (word == "∞") return kInfinite;  // .NET
  // Microsoft: 1.#INF, 1.#IND, 1.#QNAN and 1.#SNAN, rounded to the requested digits, for example 1.#J or 1.#QNAN0e+000
  const bool is_microsoft = word.size() > 3 && word[0] == '1' && (word[1] == '.' || word[1] == ',') && word[2] == '#';
  const std::string_view name = is_microsoft ? word.substr(3) : word;
  const auto is_allowed = [&](char c) { return is_alphanumeric(c) || (is_microsoft ? c == '+' || c == '-' : c == '(' || c == ')'); };
  if (!std::ranges::all_of(name, is_allowed)) return std::nullopt;
  if (is_microsoft) return starts_with_word(name, "inf") || starts_with_word(name, "j") ? kInfinite : kNan;
  if (starts_with_word(name, "nan")) return kNan;  // NaNQ, nan(0x7fc00000)
  return std::nullopt;
}

}  // namespace

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return std::nullopt;
  }
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [at, error] = std::from_chars(word.data(), end, value);
  if (at != end || error == std::errc::invalid_argument) return not_finite(word.starts_with('-') ? word.substr(1) : word);
  if (error == std::errc()) return value;
  const bool is_tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
  return is_tiny ? 0.0 : kInfinite;
}

}  // namespace halfspace::HS_LANES
