// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/naive_render.h"

#include <fmt/format.h>

#include <algorithm>

#include "halfspace/render/naive_draws.h"

namespace halfspace {

std::string naive_obstacle(const PreparedScene& scene) {
  const std::string expected = "; the naive pipeline draws opaque triangles with one sample per pixel";
  if (scene.samples != 1) return fmt::format("samples: {} per pixel{}", scene.samples, expected);
  for (const PreparedDraw& draw : scene.draws) {
    const DrawState& s = draw.state;
    const bool points = std::visit([]<class S>(const S&) { return !kDrawsTriangles<S>; }, draw.shader);
    const char* kind = points || s.topology == Topology::points              ? "points"
                       : is_lines(s.topology)                                ? "lines"
                       : s.topology != Topology::triangles                   ? "strips or fans"
                       : s.polygon_mode != PolygonMode::fill                 ? "outlines"
                       : s.order_independent || s.blend.has_value()          ? "transparent surfaces"
                       : s.offset.slope != 0.0f || s.offset.constant != 0.0f ? "a polygon offset"
                                                                             : nullptr;
    if (kind == nullptr) continue;
    return fmt::format("a draw has {}{}", kind, expected);
  }
  return {};
}

void render_naive(const PreparedScene& scene, Image<glm::vec4>& light) {
  NaiveTarget<float> target(light.width(), light.height(), vec4<float>(scene.clear_color), 0.0f);
  draw_all_naive(
      target, scene, [](const auto& shader) -> const auto& { return shader; });
  std::ranges::transform(target.color.texels(), light.data(), [](const vec4<float>& c) { return glm::vec4(c.x, c.y, c.z, c.w); });
}

}  // namespace halfspace
