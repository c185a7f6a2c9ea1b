// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool/read_webp.h"

#include "halfspace/image/tool/mapped_file.h"

namespace halfspace::HS_LANES {

#if HALFSPACE_HAS_WEBP

// libwebp's simple decoding functions. They are declared here because the packages of OpenImageIO bring the library without its headers.
extern "C" {
int WebPGetInfo(const uint8_t* data, std::size_t data_size, int* width, int* height);
uint8_t* WebPDecodeRGBAInto(const uint8_t* data, std::size_t data_size, uint8_t* output_buffer, std::size_t output_buffer_size,
                            int output_stride);
}

std::optional<Picture> read_webp(const ReadRequest& request) {
  const MappedFile file(request.file, request.file_bytes);
  int width = 0, height = 0;
  if (WebPGetInfo(file.data(), file.size(), &width, &height) == 0) return std::nullopt;
  check_claimed_size(request, width, height, 4);
  Picture p = empty_picture(width, height, {.channels = 4, .alpha_channel = 3, .pixels = {}});
  uint8_t* pixels = reinterpret_cast<uint8_t*>(p.pixels.data());
  if (WebPDecodeRGBAInto(file.data(), file.size(), pixels, p.pixels.size(), 4 * width) == nullptr) return std::nullopt;
  return p;
}

#else

std::optional<Picture> read_webp(const ReadRequest&) { return std::nullopt; }

#endif

}  // namespace halfspace::HS_LANES
