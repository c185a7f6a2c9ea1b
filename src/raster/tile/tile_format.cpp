// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/tile_format.h"

#include <algorithm>

namespace halfspace::HS_LANES {

PixelBytes encode_pixel(ColorFormat format, const PacketColor& color) {
  PixelBytes bytes{};
  const auto put = [&bytes](std::size_t k, auto value) { std::memcpy(&bytes[k * sizeof value], &value, sizeof value); };
  switch (format) {
    case ColorFormat::none: break;
    case ColorFormat::rgba8: put(0, lane(packed_codes<ColorFormat::rgba8>(color), 0)); break;
    case ColorFormat::srgb8a8: put(0, lane(packed_codes<ColorFormat::srgb8a8>(color), 0)); break;
    case ColorFormat::rgba16f:
      for (std::size_t k = 0; k < 4; ++k) put(k, static_cast<uint16_t>(lane(Int(float_to_finite_half(color[k])), 0)));
      break;
    case ColorFormat::rgba32f:
      for (std::size_t k = 0; k < 4; ++k) put(k, lane(color[k], 0));
      break;
    case ColorFormat::r32f:
    case ColorFormat::rg32f:
    case ColorFormat::rgb32f:
    case ColorFormat::r32ui:
      for (std::size_t k = 0; k < static_cast<std::size_t>(narrow_channels(format)); ++k) put(k, lane(color[k], 0));
      break;
  }
  return bytes;
}

void fill_buffer(ColorBuffer& buffer, const PacketColor& color) {
  const PixelBytes pixel = encode_pixel(buffer.format, color);
  const auto fill = [&]<class T>(T value, int planes) {
    for (int k = 0; k < planes; ++k) {
      std::memcpy(&value, &pixel[static_cast<std::size_t>(k) * sizeof(T)], sizeof(T));
      std::fill_n(plane<T>(buffer, k), kMaxTilePixels, value);
    }
  };
  switch (buffer.format) {
    case ColorFormat::none: return;
    case ColorFormat::rgba8:
    case ColorFormat::srgb8a8: return fill(uint32_t{}, 1);
    case ColorFormat::rgba16f: return fill(uint16_t{}, 4);
    case ColorFormat::rgba32f: return fill(float{}, 4);
    case ColorFormat::r32f:
    case ColorFormat::rg32f:
    case ColorFormat::rgb32f:
    case ColorFormat::r32ui: return fill(uint32_t{}, narrow_channels(buffer.format));
  }
}

}  // namespace halfspace::HS_LANES
