// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "halfspace/core/check.h"
#include "halfspace/model/geometry/face_triangles.h"
#include "halfspace/model/geometry/single_mesh.h"
#include "halfspace/model/stl/stl_triangles.h"
#include "halfspace/model/text/parse_number.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

char lower_letter(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; }

class TextParser {
 public:
  TextParser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  StlTriangles parse() {
    bool has_ended = false;
    for (std::string_view word = next(); !word.empty(); word = next()) {
      if (is(word, "facet")) {
        if (!facet()) break;
      } else if (is(word, "solid") || is(word, "endsolid")) {
        skip_name();
      } else if (has_ended) {
        warn("text after the last solid is ignored");
        break;
      } else if (!is(word, "endloop") && !is(word, "endfacet")) {
        fail(word, "'facet' or 'endsolid'");
      }
      has_ended = is(word, "endsolid");
    }
    return std::move(triangles_);
  }

 private:
  [[noreturn]] void fail(std::string_view word, std::string_view expected) const {
    const std::string found = word.empty() ? "the file ends here" : in_quotes(word);
    throw InputError(fmt::format("{}: line {}: {}; expected {}", file_, line_, found, expected));
  }

  void warn(std::string_view what) { triangles_.warnings.push_back(fmt::format("line {}: {}", line_, what)); }

  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  static bool is(std::string_view word, std::string_view keyword) {
    return std::ranges::equal(word, keyword, [](char a, char b) { return lower_letter(a) == b; });
  }

  /// Returns the next word; empty at the end.
  std::string_view next() {
    for (; at_ < text_.size() && is_space(text_[at_]); ++at_) line_ += text_[at_] == '\n' ? 1 : 0;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// Skips the rest of the line, which is a name. In files without line breaks, the name ends before "facet normal".
  void skip_name() {
    std::size_t facet = std::string_view::npos;  // where the previous word begins if it is "facet"
    for (;;) {
      while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
      const std::size_t begin = at_;
      while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
      const std::string_view word = text_.substr(begin, at_ - begin);
      if (word.empty()) return;
      if (facet != std::string_view::npos && is(word, "normal")) break;
      facet = is(word, "facet") ? begin : std::string_view::npos;
    }
    at_ = facet;
  }

  void expect(std::string_view keyword) {
    const std::string_view word = next();
    if (!is(word, keyword)) fail(word, fmt::format("'{}'", keyword));
  }

  double number() {
    const std::string_view word = next();
    const std::optional<double> value = parse_number(word);
    if (!value) fail(word, "a number");
    return *value;
  }

  // Reads a facet up to its last vertex. Returns false if the file ends within it, but has others.
  bool facet() {
    corners_.clear();
    try {
      expect("normal");
      for (int i = 0; i < 3; ++i) next();  // not used, and not always numbers
      expect("outer");
      expect("loop");
      do {
        expect("vertex");
        glm::dvec3 corner;
        for (int k = 0; k < 3; ++k) corner[k] = number();
        corners_.push_back(corner);
      } while (corners_.size() < 3 || is_next("vertex"));
    } catch (const InputError&) {
      if (at_ < text_.size() || triangles_.corners.empty()) throw;
      warn("the file ends within a facet, which is skipped");
      return false;
    }
    const auto bad = std::ranges::find_if_not(corners_, is_finite);
    if (bad != corners_.end()) {
      triangles_.corners.insert(triangles_.corners.end(), 3, glm::dvec3(*bad));  // the caller counts and removes it
    } else if (corners_.size() == 3) {
      triangles_.corners.insert(triangles_.corners.end(), corners_.begin(), corners_.end());
    } else {
      for (const uint32_t i : polygon_.of(corners_)) triangles_.corners.push_back(corners_[i]);
    }
    return true;
  }

  bool is_next(std::string_view keyword) {
    const std::size_t at = at_, line = line_;
    const bool found = is(next(), keyword);
    at_ = at;
    line_ = line;
    return found;
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, line_ = 1;
  StlTriangles triangles_;
  std::vector<glm::dvec3> corners_;  // of the current facet
  FaceTriangles polygon_;
};

// Takes words from a text without a parser's messages.
class StlWords {
 public:
  explicit StlWords(std::string_view text) : rest_(text) {}

  bool take(std::string_view keyword) {
    const std::string_view word = next();
    return std::ranges::equal(word, keyword, [](char a, char b) { return lower_letter(a) == b; });
  }
  std::string_view next() {
    constexpr std::string_view kSpaces = " \t\r\n\v\f";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpaces), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kSpaces));
    rest_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view rest_;
};

// Returns whether a facet begins at the start of the text.
bool is_facet(std::string_view text) {
  StlWords words(text);
  if (!words.take("facet") || !words.take("normal")) return false;
  for (int i = 0; i < 3; ++i) words.next();
  return words.take("outer") && words.take("loop") && words.take("vertex");
}

}  // namespace

bool is_text_stl(std::string_view contents) {
  constexpr std::size_t kBinaryHeader = 84, kMaxName = 4096;
  const std::size_t begin = contents.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return false;
  const std::string_view text = contents.substr(begin);
  if (is_facet(text)) return true;
  StlWords first(text.substr(0, 6));
  if (!first.take("solid")) return false;
  if (contents.substr(0, kBinaryHeader).find('\0') == std::string_view::npos) return true;
  for (std::size_t at = 5; at < std::min(text.size(), kMaxName); ++at) {
    if (lower_letter(text[at]) == 'f' && is_facet(text.substr(at))) return true;
  }
  return false;
}

StlTriangles text_stl_triangles(std::string_view text, const std::string& file) { return TextParser(text, file).parse(); }

}  // namespace halfspace::HS_LANES
