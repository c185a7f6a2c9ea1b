// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/text.h"

#include <algorithm>
#include <vector>

namespace halfspace::HS_LANES {

bool has_word(std::string_view text, std::string_view word) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (text.substr(0, end) == word) return true;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

// Computes the optimal string alignment distance. Only three rows of the table of prefix distances are kept.
int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  std::vector<int> before(n + 1), last(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const int replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[n];
}

std::string_view nearest_name(std::string_view wrong, std::span<const std::string_view> names) {
  if (wrong.size() > 64) return {};  // bounds the cost; no known name is that long
  std::string_view best;
  int best_distance = std::max(2, static_cast<int>(wrong.size()) / 3) + 1;
  for (const std::string_view name : names) {
    const int d = edit_distance(wrong, name);
    if (d < best_distance && d < static_cast<int>(name.size())) {
      best_distance = d;
      best = name;
    }
  }
  return best;
}

std::string suggestion(std::string_view wrong, std::span<const std::string_view> names) {
  if (const std::string_view name = nearest_name(wrong, names); !name.empty()) return "; did you mean '" + std::string(name) + "'?";
  if (names.empty()) return "; expected none, because none is defined";
  std::string text = names.size() == 1 ? "; expected " : "; expected one of ";
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : ", ") + std::string(names[i]);
  return text;
}

namespace {

// Returns the length of the UTF-8 sequence at the beginning of a text, or 0 if it is invalid (RFC 3629, section 4).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0; };
  const int first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  // Excludes encodings that are longer than necessary, surrogates, and values above U+10FFFF.
  const int low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80, high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  if (length == 0 || second < low || second > high) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  return length;
}

void append_hexadecimal(unsigned char byte, std::string& out) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  out += {kDigits[byte >> 4], kDigits[byte & 15]};
}

}  // namespace

std::string escaped(std::string_view text, std::string_view prefix) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text[0]);
    const std::size_t length = utf8_length(text);
    const std::string_view sequence = text.substr(0, std::max<std::size_t>(length, 1));
    const bool is_c1 = length == 2 && first == 0xc2 && static_cast<unsigned char>(text[1]) < 0xa0;  // U+0080 to U+009F
    if (length == 0 || first < 32 || first == 127 || is_c1) {
      for (const char byte : sequence) {
        out += prefix;
        append_hexadecimal(static_cast<unsigned char>(byte), out);
      }
    } else {
      out += sequence;
    }
    text.remove_prefix(sequence.size());
  }
  return out;
}

std::string printable(std::string_view text) { return escaped(text, "\\x"); }

std::string line_and_column(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte == 0 ? 0 : byte - 1, text.size()));
  const auto line = std::ranges::count(before, '\n') + 1;
  const std::size_t start = before.rfind('\n');
  const std::size_t column = before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1;
  return std::to_string(line) + ":" + std::to_string(column);
}

std::size_t position_of_quoted(std::string_view text, std::string_view message) {
  const std::size_t end = message.rfind('\''), before = end == 0 || end == std::string_view::npos ? end : message.rfind('\'', end - 1);
  if (before == std::string_view::npos || before >= end) return 0;
  const std::size_t found = text.find(message.substr(before + 1, end - before - 1));
  return found == std::string_view::npos ? 0 : found + 1;
}

std::string json_problem(const std::exception& e) {
  std::string what = e.what();
  if (const std::size_t end = what.find("] "); what.starts_with("[json") && end != std::string::npos) what = what.substr(end + 2);
  if (const std::size_t colon = what.find(": "); what.starts_with("parse error") && colon != std::string::npos)
    what = what.substr(colon + 2);
  if (what.starts_with("syntax error")) what = what.substr(0, what.find("; last read"));
  for (char& c : what) {
    if (static_cast<unsigned char>(c) < 32) c = ' ';
  }
  return what;
}

}  // namespace halfspace::HS_LANES
