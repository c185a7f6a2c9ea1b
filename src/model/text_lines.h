// SPDX-License-Identifier: Apache-2.0
//
// Lines, words and numbers of text files such as OBJ and MTL. All views point into the text or into the TextLines object.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "halfspace/core/namespace.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Maximum magnitude of the numbers in a model file, chosen so that squares of floats do not overflow.
inline constexpr double kMaxModelNumber = 1e18;

/// Iterates over the lines of a text, without their ends ("\n", "\r\n", or "\r" if the text has no "\n"). A line that ends in a backslash
/// continues on the next line, unless it is a comment that begins with '#'.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : text_(text), end_(text.find('\n') == std::string_view::npos ? '\r' : '\n') {}

  /// Moves to the next line. Returns false at the end of the text.
  bool next();

  /// The current line. Valid until next() is called.
  std::string_view line() const { return line_; }
  /// The number of the current line; the first line is 1. A continued line has the number of its first part.
  std::size_t number() const { return number_; }

 private:
  std::string_view take();

  std::string_view text_, line_;
  std::string joined_;
  char end_;
  std::size_t at_ = 0, number_ = 0, taken_ = 0;
};

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Returns the text without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Returns the text between two quotation marks, or all of it if it does not have them at both ends.
std::string_view without_quotes(std::string_view text);

/// Removes the first word from `rest` and returns it; empty if there is none. Words are separated by spaces and tabs.
inline std::string_view take_word(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

/// Like take_word, but a word that begins with '#' starts a comment, which ends the line.
inline std::string_view take_value(std::string_view& rest) {
  const std::string_view word = take_word(rest);
  if (!word.starts_with('#')) return word;
  rest = {};
  return {};
}

/// Returns the value of a decimal number such as "-1.5e3", or nothing if the word is not a number, not finite, or larger than
/// kMaxModelNumber. Numbers too small for a double are 0.
inline std::optional<double> number_in(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return std::nullopt;
  }
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [at, error] = std::from_chars(word.data(), end, value);
  if (at != end) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    const bool tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    return tiny ? std::optional<double>(0.0) : std::nullopt;
  }
  if (error != std::errc() || !(std::abs(value) <= kMaxModelNumber)) return std::nullopt;
  return value;
}

/// Returns a name from a file in quotation marks for use in a message: control characters are replaced, and long names are cut.
std::string in_quotes(std::string_view name);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
