// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <limits>
#include <optional>
#include <string_view>

#include "halfspace/core/namespace.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Returns the value of a decimal number such as "-1.5e3", or nullopt if the word is not a number. Unlike number_in, it accepts "nan" and
/// "inf", and returns infinity for numbers that are too large for a double. Readers skip vertices with such values.
inline std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || word.front() == '+') return std::nullopt;
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [at, error] = std::from_chars(word.data(), end, value);
  if (at != end || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc()) return value;
  const bool is_tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
  return is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
