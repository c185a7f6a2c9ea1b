// SPDX-License-Identifier: Apache-2.0
#include "naive_picture.h"

#include "raster/naive.h"

namespace halfspace {

template <class R>
Image<vec4<R>> naive_picture(const PreparedScene& scene, int width, int height) {
  NaiveTarget<R> target(width, height, vec4<R>(scene.clear_color), R(0));
  for (const PreparedDraw& draw : scene.draws) {
    std::visit([&](const auto& shader) { draw_naive(target, shader, draw.vertices, *draw.indices, draw.state); }, draw.shader);
  }
  return target.color;
}

template Image<vec4<float>> naive_picture<float>(const PreparedScene&, int, int);
template Image<vec4<double>> naive_picture<double>(const PreparedScene&, int, int);

}  // namespace halfspace
