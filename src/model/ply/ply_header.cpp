// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/ply/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/core/text.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxElements = 256, kMaxProperties = 1024;
constexpr uint64_t kMaxRows = uint64_t{1} << 31;

constexpr std::pair<std::string_view, PlyType> kTypes[] = {
    {"char", PlyType::int8},   {"uchar", PlyType::uint8},   {"short", PlyType::int16},     {"ushort", PlyType::uint16},
    {"int", PlyType::int32},   {"uint", PlyType::uint32},   {"float", PlyType::float32},   {"double", PlyType::float64},
    {"int8", PlyType::int8},   {"uint8", PlyType::uint8},   {"int16", PlyType::int16},     {"uint16", PlyType::uint16},
    {"int32", PlyType::int32}, {"uint32", PlyType::uint32}, {"float32", PlyType::float32}, {"float64", PlyType::float64}};

class HeaderParser {
 public:
  HeaderParser(std::string_view contents, const std::string& file) : contents_(contents), file_(file) {}

  PlyHeader parse() {
    if (next_line() != "ply") fail("not a PLY header; expected 'ply'");
    for (;;) {
      std::string_view rest = next_line();
      const std::string_view keyword = take_word(rest);
      if (keyword == "end_header") break;
      statement(keyword, rest);
    }
    if (!has_format_) fail("the header has no format; expected 'format ascii 1.0' or a binary format");
    header_.size = at_;
    for (const PlyElement& element : header_.elements) check_count(element);
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(fmt::format("{}: line {}: {}", file_, line_, what)); }

  // Lines end with "\n" or "\r\n". If the first line ends with "\r" alone, all lines do.
  std::string_view next_line() {
    ++line_;
    const std::string_view rest = contents_.substr(at_, kMaxHeaderBytes);
    if (line_ == 1 && rest.starts_with("ply\r") && !rest.starts_with("ply\r\n")) end_ = '\r';
    std::size_t length = rest.find(end_);
    if (length == std::string_view::npos && rest.starts_with("end_header") && rest.size() <= 12) length = rest.size();
    if (length == std::string_view::npos || at_ + length > kMaxHeaderBytes) {
      fail(fmt::format("the header does not end; expected 'end_header' within {} bytes", kMaxHeaderBytes));
    }
    at_ = std::min(at_ + length + 1, contents_.size());
    std::string_view line = rest.substr(0, length);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return trimmed(line);
  }

  void statement(std::string_view keyword, std::string_view rest) {
    if (keyword == "format") return format(rest);
    if (keyword == "element") return element(rest);
    if (keyword == "property") return property(rest);
    if (keyword == "comment") return comment(rest);
    if (keyword == "obj_info" || keyword.empty()) return;
    constexpr std::array<std::string_view, 6> kKeywords = {"format", "element", "property", "comment", "obj_info", "end_header"};
    fail(fmt::format("unknown keyword {}{}", in_quotes(keyword), suggestion(keyword, kKeywords)));
  }

  void format(std::string_view rest) {
    const std::string_view name = take_word(rest), version = take_word(rest);
    if (name == "ascii") {
      header_.encoding = PlyEncoding::ascii;
    } else if (name == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      fail(fmt::format("unknown format {}; expected ascii, binary_little_endian or binary_big_endian", in_quotes(name)));
    }
    if (version != "1.0") fail(fmt::format("unknown version {}; expected 1.0", in_quotes(version)));
    has_format_ = true;
  }

  void element(std::string_view rest) {
    PlyElement element;
    element.name = take_word(rest);
    const std::string_view count = take_word(rest);
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || error != std::errc() || end != count.data() + count.size() || element.count > kMaxRows) {
      fail(fmt::format("invalid element; expected 'element NAME COUNT' with a count of at most {}", kMaxRows));
    }
    if (header_.elements.size() == kMaxElements) fail(fmt::format("too many elements; expected at most {}", kMaxElements));
    header_.elements.push_back(std::move(element));
  }

  void property(std::string_view rest) {
    if (header_.elements.empty()) fail("a property before the first element; expected 'element NAME COUNT'");
    auto& properties = header_.elements.back().properties;
    if (properties.size() == kMaxProperties) fail(fmt::format("too many properties; expected at most {}", kMaxProperties));
    PlyProperty property;
    std::string_view type = take_word(rest);
    if (type == "list") {
      property.count_type = type_named(take_word(rest));
      if (property.count_type >= PlyType::float32) fail("a list with a fractional length; expected an integer type");
      type = take_word(rest);
    }
    property.type = type_named(type);
    property.name = take_word(rest);
    if (property.name.empty()) fail("a property without a name; expected 'property TYPE NAME'");
    properties.push_back(std::move(property));
  }

  void comment(std::string_view rest) {
    if (take_word(rest) == "TextureFile" && !trimmed(rest).empty()) header_.texture_files.emplace_back(trimmed(rest));
  }

  PlyType type_named(std::string_view name) const {
    const auto* const found = std::ranges::find(kTypes, name, &std::pair<std::string_view, PlyType>::first);
    if (found == std::end(kTypes))
      fail(fmt::format("unknown type {}; expected char, uchar, short, ushort, int, uint, float or double", in_quotes(name)));
    return found->second;
  }

  // In text files, each value takes at least one character and a separator; only the last value may have no separator.
  void check_count(const PlyElement& element) const {
    std::size_t row_bytes = 0;
    for (const PlyProperty& p : element.properties) {
      row_bytes += header_.encoding == PlyEncoding::ascii ? 2 : size_of(p.count_type.value_or(p.type));
    }
    const std::size_t bytes = contents_.size() - header_.size + 1;
    if (row_bytes > 0 && element.count > bytes / row_bytes) {
      throw InputError(fmt::format("{}: element {}: declares {} rows; expected at most {}, the most that the rest of the file can hold",
                                   file_, in_quotes(element.name), element.count, bytes / row_bytes));
    }
  }

  std::string_view contents_;
  const std::string& file_;
  PlyHeader header_;
  std::size_t at_ = 0, line_ = 0;
  char end_ = '\n';
  bool has_format_ = false;
};

// Some programs write the names of coordinates in upper case.
bool is_same_name(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

int find(const std::vector<PlyProperty>& properties, std::initializer_list<std::string_view> names, bool is_list) {
  const auto found = std::ranges::find_if(properties, [&](const PlyProperty& p) {
    const auto has_name = [&](std::string_view name) { return is_same_name(p.name, name); };
    return p.count_type.has_value() == is_list && std::ranges::any_of(names, has_name);
  });
  return found == properties.end() ? -1 : static_cast<int>(found - properties.begin());
}

}  // namespace

int PlyElement::find_value(std::initializer_list<std::string_view> names) const { return find(properties, names, false); }
int PlyElement::find_list(std::initializer_list<std::string_view> names) const { return find(properties, names, true); }

PlyHeader parse_ply_header(std::string_view contents, const std::string& file) { return HeaderParser(contents, file).parse(); }

}  // namespace halfspace::HS_LANES
