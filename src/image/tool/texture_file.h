// SPDX-License-Identifier: Apache-2.0
//
// Reads DDS and KTX2 files: texture files whose texels may be compressed in blocks. OpenImageIO reads no KTX2 and only some formats of DDS,
// and it rounds BC4 and BC5 to 8 bits, so both are read here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "halfspace/image/tool/failure.h"
#include "halfspace/image/tool/picture.h"
#include "halfspace/image/tool/service.h"

namespace halfspace::HS_LANES {

/// Read level 0 of a file with a two-dimensional texture. They throw Failure if the file is damaged, exceeds a limit, or contains a cube
/// map, an array, a volume or a format without layout (texture_layout.h). Sources: Microsoft, "Programming Guide for DDS"; Khronos, "KTX
/// File Format Specification 2.0".
Picture read_dds(const ReadRequest& request);
Picture read_ktx2(const ReadRequest& request);

/// The bytes of a texture file.
class TextureFile {
 public:
  /// `format`: the name of the format in messages.
  TextureFile(std::span<const std::byte> bytes, const char* format) : bytes_(bytes), format_(format) {}

  uint64_t size() const { return bytes_.size(); }
  const char* format() const { return format_; }

  /// Returns a part of the file, which `name` describes. Throws Failure if the file ends before the end of the part.
  std::span<const std::byte> part(uint64_t offset, uint64_t count, const char* name) const {
    if (offset > size() || count > size() - offset) {
      throw Failure{std::string(name) + " needs " + std::to_string(count) + " bytes at byte " + std::to_string(offset) +
                    ", but the file has " + std::to_string(size()) + " bytes; expected a complete " + format_ + " file"};
    }
    return bytes_.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(count));
  }

 private:
  std::span<const std::byte> bytes_;
  const char* format_;
};

/// Returns the little-endian number at an offset, which must be inside of the bytes.
template <class T = uint32_t>
T number_at(std::span<const std::byte> bytes, std::size_t offset) {
  T number;
  std::memcpy(&number, bytes.subspan(offset, sizeof number).data(), sizeof number);
  return number;
}

}  // namespace halfspace::HS_LANES
