// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/point_sprite.h"

#include <cmath>
#include <utility>

#include "halfspace/raster/pipeline/window.h"

namespace halfspace::HS_LANES {

void make_point_sprites(const Draw& draw, const float* clip, const float* extra, int count, const ScreenVertex* screen,
                        const Outcode* outcodes, PointSpriteRect* out) {
  const Viewport& v = draw.viewport;
  const auto row = [](const float* rows, int k, int i) { return static_cast<double>(rows[k * kVertexBatch + i]); };
  for (int i = 0; i < count; ++i) {
    if (draw.kernels.gives_point_sprite) {
      out[i] = {snap(row(extra, 0, i), v.half_width, v.center_x), snap(row(extra, 1, i), v.half_height, v.center_y),
                snap(row(extra, 2, i), v.half_width, v.center_x), snap(row(extra, 3, i), v.half_height, v.center_y)};
      if (v.half_height < 0.0f) std::swap(out[i].y0, out[i].y1);
      continue;
    }
    const double size = draw.kernels.gives_point_size ? row(extra, 0, i) : static_cast<double>(draw.state.point_size);
    const auto side = static_cast<int32_t>(std::nearbyint(std::fmin(std::fmax(size * kSubPixels, 0.0), 0x1p28)));
    int32_t x = screen[i].x, y = screen[i].y;
    if ((outcodes[i] & kOutGuard) != 0) {  // outside the guard band, the vertex stage does not compute a position
      x = snap(row(clip, 0, i) / row(clip, 3, i), v.half_width, v.center_x);
      y = snap(row(clip, 1, i) / row(clip, 3, i), v.half_height, v.center_y);
    }
    const int32_t x0 = x - side / 2, y0 = y - side / 2;
    out[i] = {x0, y0, x0 + side, y0 + side};
  }
}

}  // namespace halfspace::HS_LANES
