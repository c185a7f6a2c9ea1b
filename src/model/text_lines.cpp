// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/text_lines.h"

#include <algorithm>

namespace halfspace::inline HS_LANES_NAMESPACE {

std::string_view TextLines::take() {
  const std::size_t end = std::min(text_.find(end_, at_), text_.size());
  std::string_view line = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  ++taken_;
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool TextLines::next() {
  if (at_ == text_.size()) return false;
  line_ = take();
  number_ = taken_;
  if (!line_.ends_with('\\') || trimmed(line_).starts_with('#')) return true;
  joined_.clear();
  std::string_view part = line_;
  while (part.ends_with('\\')) {
    joined_.append(part.substr(0, part.size() - 1)) += ' ';
    part = at_ == text_.size() ? std::string_view() : take();
  }
  line_ = joined_.append(part);
  return true;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view without_quotes(std::string_view text) {
  return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

std::string in_quotes(std::string_view name) {
  constexpr std::size_t kMaxLength = 120;
  std::size_t length = std::min(name.size(), kMaxLength);
  while (length > 0 && length < name.size() && (name[length] & 0xc0) == 0x80) --length;  // not within a UTF-8 sequence
  std::string text(name.substr(0, length));
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return "'" + text + (length < name.size() ? "...'" : "'");
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
