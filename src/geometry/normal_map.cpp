// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/normal_map.h"

#include <cmath>

#include "halfspace/core/float_mode.h"

namespace halfspace::HS_LANES {

Image<glm::u8vec4> normal_map(const Image<float>& heights, double strength, MapEdges edges, const Workers& workers) {
  const FloatMode float_mode;
  const HeightField field(heights, 0.0, workers, edges);
  const int width = heights.width(), height = heights.height();
  Image<glm::u8vec4> map(width, height);
  const auto code = [](double x) { return static_cast<uint8_t>(std::floor((0.5 * x + 0.5) * 255.0 + 0.5)); };
  workers.for_each(height, [&](int row) {
    for (int x = 0; x < width; ++x) {
      const HeightSample h = field.at((x + 0.5) / width, (row + 0.5) / height);
      const double right = -strength * h.du / width, up = strength * h.dv / height;
      const double length = std::sqrt(right * right + up * up + 1.0);
      map.at(x, row) = {code(right / length), code(up / length), code(1.0 / length), 255};
    }
  });
  return map;
}

}  // namespace halfspace::HS_LANES
