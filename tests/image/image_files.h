// SPDX-License-Identifier: Apache-2.0
//
// Builders for small image files in formats that the renderer reads but does not write.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace halfspace {

/// Returns the lowest `bytes` bytes of a number in big-endian order.
inline std::string big_endian(uint32_t number, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(number >> shift & 0xff);
  return text;
}

/// Returns the object representation of the numbers, in host byte order.
template <class T>
std::string memory_of(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

/// Computes the checksum of a PNG chunk (CRC-32).
inline uint32_t png_checksum(std::string_view bytes) {
  uint32_t crc = ~0u;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (crc & 1u ? 0xedb88320u : 0u);
  }
  return ~crc;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<uint32_t>(data.size()), 4) + type + data + big_endian(png_checksum(type + data), 4);
}

/// Wraps the bytes (at most 65535) in a zlib stream with one stored block.
inline std::string stored_zlib(const std::string& data) {
  uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : data) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const uint32_t size = static_cast<uint32_t>(data.size());
  const std::string low_first = {static_cast<char>(size & 0xff), static_cast<char>(size >> 8)};
  const std::string inverted = {static_cast<char>(~low_first[0]), static_cast<char>(~low_first[1])};
  return "\x78\x01\x01" + low_first + inverted + data + big_endian(b << 16 | a, 4);
}

/// Builds a PNG with one row of 16-bit values. color_type: 0 is gray, 2 RGB, 4 gray and alpha, 6 RGBA.
inline std::string png16_row(const std::vector<uint16_t>& codes, int width, int color_type) {
  std::string row(1, '\0');  // filter: none
  for (const uint16_t c : codes) row += big_endian(c, 2);
  const std::string header =
      big_endian(static_cast<uint32_t>(width), 4) + big_endian(1, 4) + std::string{16, static_cast<char>(color_type), 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", stored_zlib(row)) + png_chunk("IEND", "");
}

/// Values of TIFF's SampleFormat tag.
enum class TiffSampleFormat : uint16_t { unsigned_integer = 1, signed_integer = 2, floating_point = 3 };

/// The layout of an uncompressed TIFF.
struct TiffLayout {
  uint32_t width = 1, channels = 1;
  uint32_t photometric = 1;  ///< 1: gray, 2: RGB
  TiffSampleFormat format = TiffSampleFormat::unsigned_integer;
  std::vector<std::pair<uint16_t, uint32_t>> more{};  ///< further tags with their values
};

/// Builds a TIFF with one strip; T is the sample type.
template <class T>
std::string tiff(const TiffLayout& layout, const std::vector<T>& samples) {
  static_assert(std::endian::native == std::endian::little);
  constexpr uint16_t kBits = 8 * sizeof(T);
  constexpr uint32_t kFirst = 8;  // file offset of the samples
  const auto bytes = static_cast<uint32_t>(samples.size() * sizeof(T));
  const uint32_t bits_offset = kFirst + (bytes + 1) / 2 * 2, directory = bits_offset + 2 * layout.channels;
  const uint32_t height = static_cast<uint32_t>(samples.size()) / (layout.width * layout.channels);
  struct Entry {
    uint16_t tag, type;  // type 3: 16 bits, 4: 32 bits
    uint32_t count, value;
  };
  std::vector<Entry> entries = {{256, 4, 1, layout.width},
                                {257, 4, 1, height},
                                {258, 3, layout.channels, layout.channels > 2 ? bits_offset : kBits * 0x10001u},
                                {259, 4, 1, 1},
                                {262, 4, 1, layout.photometric},
                                {273, 4, 1, kFirst},
                                {277, 4, 1, layout.channels},
                                {278, 4, 1, height},
                                {279, 4, 1, bytes},
                                {339, 3, 1, static_cast<uint32_t>(layout.format)}};
  for (const auto& [tag, value] : layout.more) entries.push_back({tag, 3, 1, value});
  std::ranges::sort(entries, {}, &Entry::tag);
  std::string file = "II*" + std::string(1, '\0') + memory_of<uint32_t>({directory}) + memory_of(samples);
  file.resize(bits_offset);
  file += memory_of(std::vector<uint16_t>(layout.channels, kBits)) + memory_of<uint16_t>({static_cast<uint16_t>(entries.size())});
  for (const Entry& e : entries) file += memory_of<uint16_t>({e.tag, e.type}) + memory_of<uint32_t>({e.count, e.value});
  return file + memory_of<uint32_t>({0});
}

/// Builds a grayscale TIFF with one row; T is the sample type.
template <class T>
std::string gray_tiff_row(const std::vector<T>& samples, TiffSampleFormat format) {
  return tiff({.width = static_cast<uint32_t>(samples.size()), .format = format}, samples);
}

/// Builds a color PFM. Rows are ordered bottom to top.
inline std::string pfm(int width, int height, const std::vector<float>& numbers) {
  return "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n" + memory_of(numbers);
}

}  // namespace halfspace
