// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/height_slopes.h"

#include <algorithm>
#include <cmath>

#include "halfspace/core/float_mode.h"

namespace halfspace::HS_LANES {

namespace {

// The neighbors of texel i on both sides, and their distance in texels.
struct Neighbors {
  int before, after, distance;
};

Neighbors neighbors(int i, int size, Wrap wrap) {
  if (wrap == Wrap::repeat) return {(i + size - 1) % size, (i + 1) % size, 2};
  const int before = std::max(i - 1, 0), after = std::min(i + 1, size - 1);
  if (wrap == Wrap::mirrored) return {before, after, 2};  // the edge texel repeats beyond the edge
  return {before, after, std::max(after - before, 1)};
}

}  // namespace

Image<glm::vec4> height_slopes(const Image<float>& heights, Wrap wrap_s, Wrap wrap_t) {
  const FloatMode float_mode;
  const int width = heights.width(), height = heights.height();
  Image<glm::vec4> slopes(width, height);
  for (int y = 0; y < height; ++y) {
    const Neighbors v = neighbors(y, height, wrap_t);
    for (int x = 0; x < width; ++x) {
      const Neighbors u = neighbors(x, width, wrap_s);
      const float du = (heights.at(u.after, y) - heights.at(u.before, y)) * static_cast<float>(width) / static_cast<float>(u.distance);
      const float dv = (heights.at(x, v.after) - heights.at(x, v.before)) * static_cast<float>(height) / static_cast<float>(v.distance);
      slopes.at(x, y) = {du, dv, 0.0f, 0.0f};
    }
  }
  return slopes;
}

Image<uint16_t> codes16(const Image<float>& heights) {
  Image<uint16_t> codes(heights.width(), heights.height());
  std::ranges::transform(heights.texels(), codes.data(),
                         [](float h) { return static_cast<uint16_t>(std::floor(std::clamp(h, 0.0f, 1.0f) * 65535.0f + 0.5f)); });
  return codes;
}

}  // namespace halfspace::HS_LANES
