// SPDX-License-Identifier: Apache-2.0
//
// Lines, words and numbers of text files such as OBJ and MTL. All views point into the text or into the TextLines object.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "halfspace/core/namespace.h"
#include "halfspace/model/text/parse_number.h"

namespace halfspace::HS_LANES {

/// Maximum magnitude of the numbers in a model file, chosen so that squares of floats do not overflow.
inline constexpr double kMaxModelNumber = 1e18;

/// Iterates over the lines of a text, without their ends ("\n", "\r\n", or "\r" if the text has no "\n"). A line that ends in a backslash
/// continues on the next line. Blanks and a comment, which is a word that begins with '#' and all that follows it, may be after the
/// backslash. Empty lines and lines with only a comment do not end a continued line if a line that begins with a number follows them.
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
  void join_lines(std::string_view first);

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

/// Returns the value of a decimal number such as "-1.5e3", or nullopt if the word is not a number, not finite, or larger than
/// kMaxModelNumber. Numbers too small for a double are 0.
inline std::optional<double> number_in(std::string_view word) {
  const std::optional<double> value = parse_number(word);
  return value && std::abs(*value) <= kMaxModelNumber ? value : std::nullopt;
}

/// Returns a name from a file in quotation marks for use in a message: control characters are replaced, and long names are cut.
std::string in_quotes(std::string_view name);

}  // namespace halfspace::HS_LANES
