// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_size.h"

#include <optional>

#include "halfspace/image/image_io.h"
#include "halfspace/image/image_source.h"
#include "halfspace/image/png.h"

namespace halfspace::HS_LANES {

namespace {

int byte_at(std::span<const std::byte> bytes, std::size_t at) { return std::to_integer<int>(bytes[at]); }
int short_at(std::span<const std::byte> bytes, std::size_t at) { return byte_at(bytes, at) << 8 | byte_at(bytes, at + 1); }

std::optional<ImageSize> png_size(std::span<const std::byte> file) {
  constexpr std::size_t kWidth = 16, kHeader = 24;
  if (!is_png(file) || file.size() < kHeader) return std::nullopt;
  const ImageSize size{short_at(file, kWidth) << 16 | short_at(file, kWidth + 2),
                       short_at(file, kWidth + 4) << 16 | short_at(file, kWidth + 6)};
  if (size.width <= 0 || size.height <= 0) return std::nullopt;
  return size;
}

// Returns whether a JPEG marker starts a frame (ITU-T T.81, table B.1).
bool starts_frame(int marker) { return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc; }

std::optional<ImageSize> jpeg_size(std::span<const std::byte> file) {
  if (file.size() < 4 || short_at(file, 0) != 0xffd8) return std::nullopt;
  for (std::size_t at = 2; at + 9 <= file.size();) {
    if (byte_at(file, at) != 0xff) return std::nullopt;
    const int marker = byte_at(file, at + 1);
    if (starts_frame(marker)) return ImageSize{short_at(file, at + 7), short_at(file, at + 5)};
    at += marker == 0xff ? 1 : 2 + static_cast<std::size_t>(short_at(file, at + 2));
  }
  return std::nullopt;
}

}  // namespace

ImageSize image_size(std::span<const std::byte> file, const std::string& name) {
  if (const std::optional<ImageSize> size = png_size(file)) return *size;
  if (const std::optional<ImageSize> size = jpeg_size(file)) return *size;
  const Image<glm::vec4> picture = read_linear(file, name);
  return {picture.width(), picture.height()};
}

ImageSize image_size(const std::filesystem::path& path) {
  ImageSource source(path, "an image");
  return image_size(source.bytes(), source.name());
}

}  // namespace halfspace::HS_LANES
