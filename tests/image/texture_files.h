// SPDX-License-Identifier: Apache-2.0
//
// Builders for DDS and KTX2 files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/image_files.h"

namespace halfspace {

/// Appends bits to a block, from the lowest bit of the first byte to the highest bit of the last one. Bits from 64 on are 0.
class BlockWriter {
 public:
  BlockWriter& put(uint64_t value, int bits) {
    for (int i = 0; i < bits; ++i) bits_.push_back(i < 64 && (value >> i & 1) != 0);
    return *this;
  }
  /// Sets a bit that was put before.
  BlockWriter& set(int bit, bool value) {
    bits_.at(static_cast<std::size_t>(bit)) = value;
    return *this;
  }
  std::string bytes(std::size_t count) const {
    std::string text(count, '\0');
    for (std::size_t i = 0; i < bits_.size(); ++i) text.at(i / 8) = static_cast<char>(text.at(i / 8) | (bits_[i] ? 1 : 0) << i % 8);
    return text;
  }

 private:
  std::vector<bool> bits_;
};

/// The fields of a DDS header that the tests change.
struct DdsHeader {
  uint32_t width = 4, height = 4;
  uint32_t flags = 4;  ///< of the pixel format; 4: the code is valid
  std::string code = "DX10";
  uint32_t bits = 0;
  std::vector<uint32_t> masks = {0, 0, 0, 0};
  uint32_t depth = 0, caps2 = 0;
  std::vector<uint32_t> extended{};  ///< the DX10 header
};

inline std::string dds(const DdsHeader& h, const std::string& level) {
  const std::string format = memory_of<uint32_t>({32, h.flags}) + h.code + memory_of<uint32_t>({h.bits}) + memory_of(h.masks);
  return "DDS " + memory_of<uint32_t>({124, 0x1007, h.height, h.width, 0, h.depth, 0}) + std::string(44, '\0') + format +
         memory_of<uint32_t>({0x1000, h.caps2, 0, 0, 0}) + memory_of(h.extended) + level;
}

/// Builds a DDS file with a DXGI_FORMAT.
inline std::string dxgi_dds(uint32_t format, uint32_t width, uint32_t height, const std::string& level) {
  return dds({.width = width, .height = height, .extended = {format, 3, 0, 1, 0}}, level);
}

/// The fields of a KTX2 file that the tests change.
struct Ktx2Header {
  uint32_t format = 37;  ///< a VkFormat; 37: R8G8B8A8_UNORM
  uint32_t width = 1, height = 1, depth = 0, layers = 0, faces = 1, scheme = 0;
  uint8_t model = 1, flags = 0;  ///< of the data format descriptor
  std::string orientation{};     ///< empty: the file does not state it
  std::string swizzle{};         ///< likewise
  uint64_t content_bytes = 0;    ///< size of level 0 before supercompression; 0: that of the level
};

/// Builds a KTX2 file with one level.
inline std::string ktx2(const Ktx2Header& h, const std::string& level) {
  constexpr uint32_t kStart = 104, kDescriptorBytes = 28;
  std::string descriptor = memory_of<uint32_t>({kDescriptorBytes, 0, 24 << 16 | 2, 0, 0, 0, 0});
  descriptor[12] = static_cast<char>(h.model);
  descriptor[15] = static_cast<char>(h.flags);
  std::string pairs;
  for (const auto& [key, value] : {std::pair("KTXorientation", h.orientation), std::pair("KTXswizzle", h.swizzle)}) {
    if (value.empty()) continue;
    const std::string pair = std::string(key) + '\0' + value + '\0';
    pairs += memory_of<uint32_t>({static_cast<uint32_t>(pair.size())}) + pair;
    pairs.resize((pairs.size() + 3) / 4 * 4);
  }
  const auto pairs_bytes = static_cast<uint32_t>(pairs.size());
  const uint64_t content = h.content_bytes == 0 ? level.size() : h.content_bytes;
  return "\xabKTX 20\xbb\r\n\x1a\n" +
         memory_of<uint32_t>({h.format, 1, h.width, h.height, h.depth, h.layers, h.faces, 1, h.scheme, kStart, kDescriptorBytes,
                              pairs_bytes == 0 ? 0 : kStart + kDescriptorBytes, pairs_bytes}) +
         memory_of<uint64_t>({0, 0, uint64_t{kStart} + kDescriptorBytes + pairs_bytes, level.size(), content}) + descriptor + pairs + level;
}

/// Wraps at most 255 bytes in a Zstandard frame with one uncompressed block (RFC 8878).
inline std::string stored_zstd(const std::string& data) {
  const auto size = static_cast<uint32_t>(data.size());
  const uint32_t block = size << 3 | 1;  // the last block, raw
  return "\x28\xb5\x2f\xfd\x20" + std::string{static_cast<char>(size), static_cast<char>(block), static_cast<char>(block >> 8), '\0'} +
         data;
}

}  // namespace halfspace
