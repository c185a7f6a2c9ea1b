// SPDX-License-Identifier: Apache-2.0
#include "render/naive_picture.h"

#include "halfspace/raster/naive.h"

namespace halfspace {

namespace {

// S, optionally with the vertex positions that float arithmetic gives.
template <class S>
struct Placed : S {
  Positions positions;

  template <class R>
  vec4<R> vertex(const typename S::template Attributes<R>& in, typename S::template Varyings<R>& out) const {
    const vec4<R> pos_clip = S::vertex(in, out);
    if (positions == Positions::in_r) return pos_clip;
    const auto wide = to_components<R>(in);
    std::array<float, wide.size()> narrow{};
    std::ranges::transform(wide, narrow.begin(), [](R x) { return static_cast<float>(x); });
    typename S::template Varyings<float> unused;
    return vec4<R>(S::vertex(from_components<typename S::template Attributes<float>, float>(narrow), unused));
  }
};

}  // namespace

template <class R>
Image<vec4<R>> naive_picture(const PreparedScene& scene, int width, int height, Positions positions) {
  NaiveTarget<R> target(width, height, vec4<R>(scene.clear_color), R(0));
  for (const PreparedDraw& draw : scene.draws) {
    std::visit(
        [&]<class S>(const S& shader) {
          if constexpr (kGivesPointSprite<S> || kGivesPointSize<S>) {
            HS_CHECK(false);  // the naive pipeline does not support points
          } else {
            draw_naive(target, Placed<S>{shader, positions}, draw.vertices, *draw.indices, draw.state);
          }
        },
        draw.shader);
  }
  return target.color;
}

template Image<vec4<float>> naive_picture<float>(const PreparedScene&, int, int, Positions);
template Image<vec4<double>> naive_picture<double>(const PreparedScene&, int, int, Positions);

}  // namespace halfspace
