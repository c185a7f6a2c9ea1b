// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/text/text_lines.h"

#include <algorithm>

namespace halfspace::HS_LANES {

namespace {

// Returns the line without a comment: a word that begins with '#', or with a backslash and '#'.
std::string_view without_comment(std::string_view line) {
  const auto begins_word = [&](std::size_t at) { return at == 0 || is_blank(line[at - 1]); };
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    if (begins_word(at) || (line[at - 1] == '\\' && begins_word(at - 1))) return line.substr(0, at);
  }
  return line;
}

// Returns the part of a line before the backslash that continues it, or nullopt if there is none.
std::optional<std::string_view> before_continuation(std::string_view line) {
  if (line.find('\\') == std::string_view::npos) return std::nullopt;
  line = trimmed(without_comment(line));
  if (!line.ends_with('\\')) return std::nullopt;
  return line.substr(0, line.size() - 1);
}

// Returns whether the text has nothing but a comment.
bool is_empty_line(std::string_view line) { return trimmed(without_comment(line)).empty(); }

bool begins_with_number(std::string_view line) {
  line = trimmed(line);
  return !line.empty() && std::string_view("0123456789+-.").find(line[0]) != std::string_view::npos;
}

}  // namespace

std::string_view TextLines::take() {
  const std::size_t end = std::min(text_.find(end_, at_), text_.size());
  std::string_view line = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  ++taken_;
  while (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool TextLines::next() {
  if (at_ == text_.size()) return false;
  line_ = take();
  number_ = taken_;
  if (const std::optional<std::string_view> first = before_continuation(line_)) join_lines(*first);
  return true;
}

void TextLines::join_lines(std::string_view first) {
  joined_ = first;
  bool more = true;
  while (more && at_ != text_.size()) {
    const std::string_view part = take();
    const std::optional<std::string_view> continued = before_continuation(part);
    const bool is_empty = !continued && is_empty_line(part);
    (joined_ += ' ') += is_empty ? std::string_view() : continued.value_or(part);
    const std::string_view following = text_.substr(at_, text_.find(end_, at_) - at_);
    more = continued || (is_empty && (is_empty_line(following) || begins_with_number(following)));
  }
  line_ = joined_;
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

}  // namespace halfspace::HS_LANES
