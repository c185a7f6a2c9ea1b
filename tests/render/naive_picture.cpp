// SPDX-License-Identifier: Apache-2.0
#include "render/naive_picture.h"

#include <algorithm>

#include "halfspace/render/frame/naive_draws.h"
#include "halfspace/render/frame/naive_render.h"

namespace halfspace {

namespace {

// The shader S, optionally with vertex positions computed in float arithmetic.
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

template <>
Image<vec4<double>> naive_picture<double>(const PreparedScene& scene, int width, int height, Positions positions) {
  NaiveTarget<double> target(width, height, vec4<double>(scene.clear_color), 0.0);
  draw_all_naive(target, scene, [&]<class S>(const S& shader) { return Placed<S>{shader, positions}; });
  return target.color;
}

template <>
Image<vec4<float>> naive_picture<float>(const PreparedScene& scene, int width, int height, Positions) {
  Image<glm::vec4> light(width, height);
  render_naive(scene, light);
  Image<vec4<float>> out(width, height);
  std::ranges::transform(light.texels(), out.data(), [](const glm::vec4& c) { return vec4<float>(c); });
  return out;
}

}  // namespace halfspace
