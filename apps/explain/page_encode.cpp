// SPDX-License-Identifier: Apache-2.0
#include "explain/page_encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "halfspace/core/srgb_curve.h"
#include "halfspace/image/png.h"

namespace halfspace {

namespace {

constexpr int kPackedWidth = 1024;

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? std::to_integer<uint32_t>(bytes[i + k]) : 0);
    for (int k = 0; k < 4; ++k) out += kDigits[group >> (18 - 6 * k) & 63];
  }
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  std::fill(out.end() - static_cast<std::ptrdiff_t>(padding), out.end(), '=');
  return out;
}

}  // namespace

std::string picture_uri(const Image<glm::u8vec4>& picture) { return fmt::format("data:image/png;base64,{}", base64(encode_png(picture))); }

std::string packed_bytes(std::span<const std::byte> bytes) {
  if (bytes.empty()) return {};
  const std::size_t pixels = (bytes.size() + 2) / 3;
  Image<glm::u8vec4> image(kPackedWidth, static_cast<int>((pixels + kPackedWidth - 1) / kPackedWidth));
  std::fill_n(image.data(), image.texels().size(), glm::u8vec4(0, 0, 0, 255));
  for (std::size_t i = 0; i < bytes.size(); ++i) image.data()[i / 3][static_cast<int>(i % 3)] = std::to_integer<uint8_t>(bytes[i]);
  return base64(encode_png(image, PngCodes::numbers));
}

glm::u8vec4 heat_color(float t) {
  static constexpr std::array<std::array<float, 3>, 7> kRamp{
      {{24, 18, 62}, {42, 56, 128}, {28, 106, 146}, {34, 152, 134}, {112, 190, 92}, {230, 216, 88}, {255, 250, 214}}};
  const float x = std::clamp(t, 0.0f, 1.0f) * (kRamp.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), kRamp.size() - 2);
  const float f = x - static_cast<float>(i);
  glm::u8vec4 c(0, 0, 0, 255);
  for (std::size_t k = 0; k < 3; ++k)
    c[static_cast<int>(k)] = static_cast<uint8_t>(kRamp[i][k] + (kRamp[i + 1][k] - kRamp[i][k]) * f + 0.5f);
  return c;
}

glm::u8vec4 srgb_code(const glm::vec3& linear) {
  glm::u8vec4 c(0, 0, 0, 255);
  for (int k = 0; k < 3; ++k) c[k] = static_cast<uint8_t>(srgb_curve(std::clamp(linear[k], 0.0f, 1.0f)) * 255.0f + 0.5f);
  return c;
}

std::string script_safe(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  char last = ' ';
  for (const char c : json) {
    if (last == '<' && c == '/') out += '\\';
    out += c;
    last = c;
  }
  return out;
}

}  // namespace halfspace
