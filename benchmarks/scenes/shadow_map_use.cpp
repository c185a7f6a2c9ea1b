// SPDX-License-Identifier: Apache-2.0
#include "scenes/shadow_map_use.h"

#include <algorithm>
#include <cmath>

namespace halfspace {

namespace {

constexpr int kTile = 64;

// Marks the texels that pixel (x, y) reads.
void mark_reads(Image<uint8_t>& is_read, const glm::dvec2& light_ndc) {
  const auto texel = [](double ndc, int count) { return static_cast<int>(std::floor(0.5 * count * (ndc + 1))); };
  const int i = texel(light_ndc.x, is_read.width()), j = texel(light_ndc.y, is_read.height());
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di)
      is_read.at(std::clamp(i + di, 0, is_read.width() - 1), is_read.height() - 1 - std::clamp(j + dj, 0, is_read.height() - 1)) = 1;
  }
}

// Counts the tile whose first texel is (x0, y0).
void count_tile(ShadowMapUse& use, const Image<uint8_t>& is_read, const Image<float>& map, int x0, int y0) {
  int read = 0;
  bool is_filled = false;
  for (int y = y0; y < std::min(y0 + kTile, map.height()); ++y) {
    for (int x = x0; x < std::min(x0 + kTile, map.width()); ++x) {
      read += is_read.at(x, y);
      is_filled = is_filled || map.at(x, y) < 1.0f;
    }
  }
  ++use.tiles;
  use.read_texels += read;
  if (is_filled) ++use.filled_tiles;
  if (read > 0) ++use.read_tiles;
  if (is_filled && read > 0) ++use.read_filled_tiles;
}

}  // namespace

ShadowMapUse shadow_map_use(const Image<float>& depth, const glm::dmat4& clip_from_world, const glm::dmat4& light_from_world,
                            const Image<float>& map) {
  const glm::dmat4 light_from_clip = light_from_world * glm::inverse(clip_from_world);
  Image<uint8_t> is_read(map.width(), map.height());
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      if (depth.at(x, y) >= 1.0f) continue;
      const glm::dvec4 p = light_from_clip * glm::dvec4(2 * (x + 0.5) / depth.width() - 1, 1 - 2 * (y + 0.5) / depth.height(),
                                                        2.0 * static_cast<double>(depth.at(x, y)) - 1, 1);
      mark_reads(is_read, glm::dvec2(p) / p.w);
    }
  }
  ShadowMapUse use;
  use.texels = map.width() * map.height();
  for (int y = 0; y < map.height(); y += kTile) {
    for (int x = 0; x < map.width(); x += kTile) count_tile(use, is_read, map, x, y);
  }
  return use;
}

}  // namespace halfspace
