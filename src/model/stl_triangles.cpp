// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/stl_triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "halfspace/core/check.h"
#include "halfspace/model/parse_number.h"
#include "halfspace/model/text_lines.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

constexpr std::size_t kHeaderBytes = 84, kTriangleBytes = 50;

template <class T>
T value_at(std::span<const std::byte> bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; }

class TextParser {
 public:
  TextParser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  StlTriangles parse() {
    expect("solid");
    skip_name();
    for (std::string_view word = next(); !word.empty(); word = next()) {
      if (is(word, "facet")) {
        facet();
      } else if (is(word, "solid") || is(word, "endsolid")) {
        skip_name();
      } else {
        fail(word, "'facet' or 'endsolid'");
      }
    }
    return std::move(triangles_);
  }

 private:
  [[noreturn]] void fail(std::string_view word, std::string_view expected) const {
    const std::string found = word.empty() ? "the file ends here" : in_quotes(word);
    throw InputError(fmt::format("{}: line {}: {}; expected {}", file_, line_, found, expected));
  }

  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  static bool is(std::string_view word, std::string_view keyword) {
    return std::ranges::equal(word, keyword, [](char a, char b) { return lower(a) == b; });
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

  void facet() {
    expect("normal");
    for (int i = 0; i < 3; ++i) next();  // not used, and not always numbers: some programs write "-nan(ind)"
    expect("outer");
    expect("loop");
    for (int i = 0; i < 3; ++i) {
      expect("vertex");
      glm::dvec3 corner;
      for (int k = 0; k < 3; ++k) corner[k] = number();
      triangles_.corners.push_back(corner);
    }
    expect("endloop");
    expect("endfacet");
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, line_ = 1;
  StlTriangles triangles_;
};

}  // namespace

StlTriangles binary_stl_triangles(std::span<const std::byte> bytes, const std::string& file) {
  if (bytes.size() < kHeaderBytes) throw InputError(fmt::format("{}: {} bytes; expected at least {}", file, bytes.size(), kHeaderBytes));
  const auto count = std::size_t{value_at<uint32_t>(bytes, 80)};
  if (count > (bytes.size() - kHeaderBytes) / kTriangleBytes) {
    throw InputError(fmt::format("{}: declares {} triangles but has {} bytes; expected {} bytes", file, count, bytes.size(),
                                 kHeaderBytes + count * kTriangleBytes));
  }
  StlTriangles triangles;
  triangles.corners.resize(3 * count);
  triangles.attributes.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t begin = kHeaderBytes + t * kTriangleBytes;
    const auto numbers = value_at<std::array<float, 12>>(bytes, begin);
    for (std::size_t k = 0; k < 3; ++k)
      triangles.corners[3 * t + k] = glm::dvec3(numbers[3 * k + 3], numbers[3 * k + 4], numbers[3 * k + 5]);
    triangles.attributes[t] = value_at<uint16_t>(bytes, begin + 48);
  }
  return triangles;
}

StlTriangles text_stl_triangles(std::string_view text, const std::string& file) { return TextParser(text, file).parse(); }

}  // namespace halfspace::inline HS_LANES_NAMESPACE
