// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#if HALFSPACE_HAS_ZLIB
#include <zlib.h>
#endif
#if HALFSPACE_HAS_ZSTD
#include <zstd.h>
#endif

#include "halfspace/image/tool/mapped_file.h"
#include "halfspace/image/tool/texture_file.h"
#include "halfspace/image/tool/texture_layout.h"

namespace halfspace::HS_LANES {

namespace {

// Offsets and sizes in bytes.
constexpr std::size_t kHeaderBytes = 80, kLevelBytes = 24;
constexpr std::size_t kFormat = 12, kWidth = 20, kHeight = 24, kDepth = 28, kLayers = 32, kFaces = 36, kScheme = 44;
constexpr std::size_t kDescriptorOffset = 48, kDescriptorBytes = 52, kValuesOffset = 56, kValuesBytes = 60;

// The data format descriptor: the color model and flags of its first block.
constexpr std::size_t kColorModel = 12, kDescriptorFlags = 15, kMinDescriptorBytes = 16;
constexpr uint8_t kPremultiplied = 1;
constexpr uint8_t kEtc1s = 163, kUastc = 166;

enum Scheme : uint32_t { kNone = 0, kBasisLz = 1, kZstandard = 2, kZlib = 3 };

// Uncompresses a level to `bytes` bytes. Returns nothing if that is not the size of its content, or if it is damaged.
std::optional<std::vector<std::byte>> uncompressed([[maybe_unused]] std::span<const std::byte> level, std::size_t bytes, uint32_t scheme) {
  std::vector<std::byte> out(bytes);
#if HALFSPACE_HAS_ZSTD
  if (scheme == kZstandard) {
    if (ZSTD_decompress(out.data(), out.size(), level.data(), level.size()) != bytes) return std::nullopt;
    return out;
  }
#endif
#if HALFSPACE_HAS_ZLIB
  if (scheme == kZlib) {
    uLongf size = bytes;
    const int result =
        ::uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(level.data()), level.size());
    if (result != Z_OK || size != bytes) return std::nullopt;
    return out;
  }
#endif
  throw Failure{std::string("is compressed with ") + (scheme == kZlib ? "zlib" : "Zstandard") +
                ", which this build cannot read; expected a file without supercompression"};
}

struct Descriptor {
  uint8_t model = 0;
  bool premultiplied = false;
};

Descriptor descriptor_of(const TextureFile& file, std::span<const std::byte> header) {
  const auto bytes = file.part(number_at(header, kDescriptorOffset), number_at(header, kDescriptorBytes), "the data format descriptor");
  if (bytes.size() < kMinDescriptorBytes) return {};
  return {number_at<uint8_t>(bytes, kColorModel), (number_at<uint8_t>(bytes, kDescriptorFlags) & kPremultiplied) != 0};
}

// Returns the value for a key without the zero at its end, or nothing.
std::optional<std::string_view> value_of(std::span<const std::byte> pairs, std::string_view key) {
  while (pairs.size() >= sizeof(uint32_t)) {
    const std::size_t rest = pairs.size() - sizeof(uint32_t), bytes = std::min<std::size_t>(number_at(pairs, 0), rest);
    const std::string_view pair(reinterpret_cast<const char*>(pairs.data()) + sizeof(uint32_t), bytes);
    const std::size_t end = std::min(pair.find('\0'), pair.size());
    if (pair.substr(0, end) == key) {
      std::string_view value = pair.substr(std::min(end + 1, pair.size()));
      return value.substr(0, value.find('\0'));
    }
    pairs = pairs.subspan(sizeof(uint32_t) + std::min((bytes + 3) / 4 * 4, rest));
  }
  return std::nullopt;
}

// Returns the orientation (see upright) that the file states: whether columns follow each other to the right or to the left, and whether
// rows follow each other down or up.
int orientation_of(std::span<const std::byte> pairs) {
  const std::string_view value = value_of(pairs, "KTXorientation").value_or("rd");
  if (value == "rd") return 1;
  if (value == "ld") return 2;
  if (value == "lu") return 3;
  if (value == "ru") return 4;
  throw Failure{"has the orientation \"" + one_line(std::string(value)) + "\"; expected rd, ru, ld or lu"};
}

// Refuses channels that a reader has to exchange. Files state the order that Halfspace uses anyway in several ways.
void check_swizzle(std::span<const std::byte> pairs) {
  const std::string_view value = value_of(pairs, "KTXswizzle").value_or("rgba");
  if (value == "rgba" || value == "rgb1" || value == "rg01" || value == "r001" || value == "rrr1") return;
  throw Failure{"has the swizzle \"" + one_line(std::string(value)) + "\"; expected none, or one that keeps the channels"};
}

std::string name_of_format(uint32_t format, const Descriptor& descriptor) {
  if (descriptor.model == kEtc1s) return "Basis Universal (ETC1S) texels";
  if (descriptor.model == kUastc) return "Basis Universal (UASTC) texels";
  return "texels of the Vulkan format " + std::to_string(format);
}

void check_shape(std::span<const std::byte> header) {
  if (number_at(header, kHeight) == 0) throw Failure{"is a one-dimensional texture; expected two dimensions"};
  if (number_at(header, kDepth) > 0) throw Failure{"is a volume; expected a two-dimensional texture"};
  if (number_at(header, kFaces) != 1) throw Failure{"is a cube map; expected a two-dimensional texture"};
  if (number_at(header, kLayers) > 1) {
    throw Failure{"is an array of " + std::to_string(number_at(header, kLayers)) + " textures; expected a two-dimensional texture"};
  }
}

}  // namespace

Picture read_ktx2(const ReadRequest& request) {
  const MappedFile mapped(request.file, request.file_bytes);
  const TextureFile file(std::as_bytes(std::span(mapped.data(), mapped.size())), "KTX2");
  const auto header = file.part(0, kHeaderBytes + kLevelBytes, "the header");
  check_shape(header);
  const uint32_t number = number_at(header, kFormat), scheme = number_at(header, kScheme);
  const Descriptor descriptor = descriptor_of(file, header);
  const std::optional<TextureLayout> layout = layout_of_vk_format(number);
  if (!layout || scheme == kBasisLz) {
    throw Failure{"has " + name_of_format(number, descriptor) +
                  "; expected BC1 to BC7, or uncompressed normalized or floating-point channels"};
  }
  if (scheme > kZlib)
    throw Failure{"has the supercompression scheme " + std::to_string(scheme) + "; expected 0, 2 (Zstandard) or 3 (zlib)"};
  const uint32_t width = number_at(header, kWidth), height = number_at(header, kHeight);
  check_texture_size(request, *layout, width, height);
  const auto pairs = file.part(number_at(header, kValuesOffset), number_at(header, kValuesBytes), "the key/value data");
  const int orientation = orientation_of(pairs);
  check_swizzle(pairs);
  const std::size_t bytes = level_bytes(*layout, width, height);
  const uint64_t offset = number_at<uint64_t>(header, kHeaderBytes), stored = number_at<uint64_t>(header, kHeaderBytes + 8);
  std::span<const std::byte> level = file.part(offset, scheme == kNone ? bytes : stored, "level 0");
  std::vector<std::byte> memory;
  if (scheme != kNone) {
    std::optional<std::vector<std::byte>> content = uncompressed(level, bytes, scheme);
    if (!content) {
      throw Failure{"level 0, " + std::to_string(stored) + " bytes at byte " + std::to_string(offset) + ", is damaged; expected " +
                    std::to_string(bytes) + " bytes compressed with " + (scheme == kZlib ? "zlib" : "Zstandard")};
    }
    memory = *std::move(content);
    level = memory;
  }
  Picture picture = picture_of_level(*layout, level, width, height);
  if (descriptor.premultiplied) divide_by_alpha(picture);
  return upright(std::move(picture), orientation);
}

}  // namespace halfspace::HS_LANES
