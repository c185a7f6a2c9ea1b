// SPDX-License-Identifier: Apache-2.0
#include "scene/earth.h"

#include "scene/image_io.h"
#include "scene/procedural_earth.h"

namespace halfspace {

RenderResult render_earth(const EarthOptions& options, const Workers& workers) {
  const Image<glm::u8vec4> map = options.color_map.empty() ? procedural_earth(1024, 512, workers) : read_image(options.color_map);
  RenderResult result{Image<glm::u8vec4>(options.width, options.height), {}};
  for (int y = 0; y < options.height; ++y) {
    const int row = static_cast<int>(static_cast<int64_t>(y) * map.height() / options.height);
    for (int x = 0; x < options.width; ++x) {
      result.image.at(x, y) = map.at(static_cast<int>(static_cast<int64_t>(x) * map.width() / options.width), row);
    }
  }
  return result;
}

}  // namespace halfspace
