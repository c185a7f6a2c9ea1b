// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/tile_format.h"

#include <algorithm>
#include <bit>

namespace halfspace::HS_LANES {

PacketColor nearest_color(ColorFormat format, const PacketColor& color) {
  if (has_word_channels(format)) return color;
  if (is_integer(format)) {
    const std::array<Int, 4> integers =
        nearest_integers<Real>(format, {as_int(color[0]), as_int(color[1]), as_int(color[2]), as_int(color[3])});
    return {as_real(integers[0]), as_real(integers[1]), as_real(integers[2]), as_real(integers[3])};
  }
  const vec4<Real> nearest = nearest_texel(format, vec4<Real>(color[0], color[1], color[2], color[3]));
  return {nearest.x, nearest.y, nearest.z, nearest.w};
}

PixelBytes encode_pixel(ColorFormat format, const PacketColor& color) {
  PixelBytes bytes{};
  const PacketColor nearest = nearest_color(format, color);  // finite, as in a tile
  const glm::vec4 value(lane(nearest[0], 0), lane(nearest[1], 0), lane(nearest[2], 0), lane(nearest[3], 0));
  if (is_integer(format)) {
    encode_integers(format, std::bit_cast<glm::ivec4>(value), bytes.data());
  } else {
    encode_texel(format, value, bytes.data());
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
    case ColorFormat::rgba8:
    case ColorFormat::srgb8a8: return fill(uint32_t{}, 1);
    case ColorFormat::rgba16f: return fill(uint16_t{}, 4);
    default: break;
  }
  const PacketColor nearest = nearest_color(buffer.format, color);
  for (int k = 0; k < word_planes(buffer.format); ++k)
    std::fill_n(plane<int32_t>(buffer, k), kMaxTilePixels, lane(as_int(nearest[static_cast<std::size_t>(k)]), 0));
}

}  // namespace halfspace::HS_LANES
