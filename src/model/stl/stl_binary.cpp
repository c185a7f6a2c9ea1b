// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "halfspace/core/check.h"
#include "halfspace/model/stl/stl_triangles.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kHeaderBytes = 84, kTriangleBytes = 50;

template <class T>
T value_at(std::span<const std::byte> bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

// A way to divide the bytes after the header into triangles.
struct StlLayout {
  bool has_payload = false;  ///< the attribute of a triangle is the number of bytes that follow it
  std::size_t triangles = 0, plausible = 0, end = kHeaderBytes;
};

// Returns whether the normal and the corners of a triangle look like numbers that a program wrote: the normal is zero or has unit length,
// and the corners can be drawn. Misplaced bytes rarely do.
bool is_plausible(std::span<const std::byte> bytes, std::size_t begin) {
  const auto numbers = value_at<std::array<float, 12>>(bytes, begin);
  const double x = static_cast<double>(numbers[0]), y = static_cast<double>(numbers[1]), z = static_cast<double>(numbers[2]);
  const double length = x * x + y * y + z * z;
  if (length != 0.0 && !(std::abs(length - 1.0) < 0.01)) return false;
  return std::all_of(numbers.begin() + 3, numbers.end(), [](float n) {
    const double size = std::abs(static_cast<double>(n));
    return size == 0.0 || (size > 1e-12 && size < kMaxModelNumber);
  });
}

// Divides the bytes into at most `count` triangles.
StlLayout layout_of(std::span<const std::byte> bytes, std::size_t count, bool has_payload) {
  StlLayout layout{.has_payload = has_payload};
  while (layout.triangles < count && layout.end + kTriangleBytes <= bytes.size()) {
    const std::size_t payload = has_payload ? value_at<uint16_t>(bytes, layout.end + 48) : 0;
    if (payload > bytes.size() - layout.end - kTriangleBytes) break;
    layout.plausible += is_plausible(bytes, layout.end) ? 1 : 0;
    layout.end += kTriangleBytes + payload;
    ++layout.triangles;
  }
  return layout;
}

// Returns the layout that fits the size of the file and, if none or both do, the one with more plausible triangles.
StlLayout best_layout(std::span<const std::byte> bytes, std::size_t declared) {
  const std::size_t available = (bytes.size() - kHeaderBytes) / kTriangleBytes;
  if (bytes.size() == kHeaderBytes + declared * kTriangleBytes) return {.triangles = declared, .end = bytes.size()};
  const std::size_t count = declared == 0 ? available : std::min(declared, available);
  const StlLayout plain = layout_of(bytes, count, false), payload = layout_of(bytes, count, true);
  const auto fits = [&](const StlLayout& layout) {
    return layout.end == bytes.size() && (layout.triangles == declared || declared == 0 || declared > available);
  };
  if (fits(plain) != fits(payload)) return fits(plain) ? plain : payload;
  return payload.plausible > plain.plausible ? payload : plain;
}

// Returns the color of the part from a header of Materialise Magics: "COLOR=" and four bytes, or else the first color after "MATERIAL=".
std::optional<glm::u8vec4> header_color(std::string_view header) {
  for (const std::string_view key : {"COLOR=", "MATERIAL="}) {
    const std::size_t at = header.find(key);
    if (at == std::string_view::npos || at + key.size() + 4 > header.size()) continue;
    glm::u8vec4 color;
    for (std::size_t i = 0; i < 4; ++i) color[static_cast<glm::length_t>(i)] = static_cast<uint8_t>(header[at + key.size() + i]);
    return color;
  }
  return std::nullopt;
}

// Returns whether the first bytes are those of a text, which may be in any language.
bool looks_like_text(std::span<const std::byte> bytes) {
  constexpr std::size_t kSample = 512;
  return std::ranges::none_of(bytes.subspan(0, std::min(bytes.size(), kSample)), [](std::byte b) {
    const auto c = static_cast<uint8_t>(b);
    return c < 0x20 && !(c >= '\t' && c <= '\r');
  });
}

void add_warnings(StlTriangles& triangles, std::size_t declared, const StlLayout& layout, std::size_t size) {
  if (declared != layout.triangles)
    triangles.warnings.push_back(fmt::format("declares {} triangles, but has {}", declared, layout.triangles));
  if (layout.end < size) triangles.warnings.push_back(fmt::format("{} bytes after the last triangle are ignored", size - layout.end));
  const std::size_t payload = layout.end - kHeaderBytes - layout.triangles * kTriangleBytes;
  if (payload > 0) triangles.warnings.push_back(fmt::format("{} bytes of attribute data are not used", payload));
}

}  // namespace

StlTriangles binary_stl_triangles(std::span<const std::byte> bytes, const std::string& file) {
  if (bytes.size() < kHeaderBytes) throw InputError(fmt::format("{}: {} bytes; expected at least {}", file, bytes.size(), kHeaderBytes));
  const auto declared = std::size_t{value_at<uint32_t>(bytes, 80)};
  if (declared > (bytes.size() - kHeaderBytes) / kTriangleBytes && looks_like_text(bytes)) {
    throw InputError(fmt::format("{}: is not an STL file: declares {} triangles in {} bytes; expected a binary or a text STL file", file,
                                 declared, bytes.size()));
  }
  const StlLayout layout = best_layout(bytes, declared);
  StlTriangles triangles;
  triangles.corners.reserve(3 * layout.triangles);
  if (!layout.has_payload) triangles.attributes.reserve(layout.triangles);
  std::size_t begin = kHeaderBytes;
  for (std::size_t t = 0; t < layout.triangles; ++t) {
    const auto n = value_at<std::array<float, 12>>(bytes, begin);
    for (std::size_t k = 3; k < 12; k += 3) triangles.corners.emplace_back(n[k], n[k + 1], n[k + 2]);
    const auto attribute = value_at<uint16_t>(bytes, begin + 48);
    if (!layout.has_payload) triangles.attributes.push_back(attribute);
    begin += kTriangleBytes + (layout.has_payload ? attribute : 0);
  }
  triangles.color = header_color({reinterpret_cast<const char*>(bytes.data()), 80});
  add_warnings(triangles, declared, layout, bytes.size());
  return triangles;
}

}  // namespace halfspace::HS_LANES
