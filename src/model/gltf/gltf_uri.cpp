// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_uri.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace halfspace::HS_LANES {

namespace {

constexpr uint8_t kInvalid = 255;

constexpr std::array<uint8_t, 256> base64_codes() {
  std::array<uint8_t, 256> codes{};
  codes.fill(kInvalid);
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kLetters.size(); ++i) codes[static_cast<uint8_t>(kLetters[i])] = static_cast<uint8_t>(i);
  return codes;
}

std::optional<std::vector<std::byte>> base64_decoded(std::string_view text) {
  static constexpr std::array<uint8_t, 256> kCodes = base64_codes();
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<std::byte> bytes(text.size() / 4 * 3 + (text.size() % 4 == 0 ? 0 : text.size() % 4 - 1));
  uint32_t bits = 0;
  int bit_count = 0;
  std::size_t n = 0;
  for (const char c : text) {
    const uint8_t code = kCodes[static_cast<uint8_t>(c)];
    if (code == kInvalid) return std::nullopt;
    bits = bits << 6 | code;
    bit_count += 6;
    if (bit_count < 8) continue;
    bit_count -= 8;
    bytes[n++] = static_cast<std::byte>(bits >> bit_count & 0xff);
  }
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  constexpr std::string_view kScheme = "data:";
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return uri.size() >= kScheme.size() && std::ranges::equal(uri.substr(0, kScheme.size()), kScheme, {}, lower);
}

std::optional<std::vector<std::byte>> data_of_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string_view data = uri.substr(comma + 1);
  if (uri.substr(0, comma).ends_with(";base64")) return base64_decoded(data);
  const std::string decoded = percent_decoded(data);
  std::vector<std::byte> bytes(decoded.size());
  std::ranges::transform(decoded, bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
  return bytes;
}

std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
    decoded += low >= 0 ? static_cast<char>(high * 16 + low) : text[i];
    if (low >= 0) i += 2;
  }
  return decoded;
}

}  // namespace halfspace::HS_LANES
