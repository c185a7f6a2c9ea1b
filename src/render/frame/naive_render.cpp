// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/frame/naive_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "halfspace/core/float_mode.h"
#include "halfspace/render/frame/naive_draws.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace::HS_LANES {

namespace {

constexpr const char* kNaiveDraws = "expected opaque triangles with one sample per pixel, which is all that the naive pipeline draws";

// Returns what the naive pipeline does not draw, or null if it draws the draw.
const char* missing_feature(const PreparedDraw& draw) {
  const DrawState& s = draw.state;
  if (std::holds_alternative<NormalLines>(draw.shader)) return "lines of normals";
  if (!std::visit([]<class S>(const S&) { return kDrawsTriangles<S>; }, draw.shader) || s.topology == Topology::points) return "points";
  if (is_lines(s.topology)) return "lines";
  if (s.topology != Topology::triangles) return "strips or fans";
  if (s.polygon_mode != PolygonMode::fill) return "outlines";
  if (s.order_independent || s.blend) return "blending";
  return nullptr;
}

}  // namespace

std::string naive_obstacle(const PreparedScene& scene, const SceneDescription& description) {
  if (scene.samples != 1) return fmt::format("samples: is {}; {}", scene.samples, kNaiveDraws);
  for (const PreparedDraw& draw : scene.draws) {
    if (const char* feature = missing_feature(draw))
      return fmt::format("{}: is drawn with {}; {}", object_path(description, draw.source.object), feature, kNaiveDraws);
  }
  return {};
}

void render_naive(const PreparedScene& scene, Image<glm::vec4>& light) {
  const FloatMode float_mode;
  NaiveTarget<float> target(light.width(), light.height(), vec4<float>(scene.clear_color), 0.0f);
  draw_all_naive(
      target, scene, [](const auto& shader) -> const auto& { return shader; });
  std::ranges::transform(target.color.texels(), light.data(), [](const vec4<float>& c) { return glm::vec4(c.x, c.y, c.z, c.w); });
}

}  // namespace halfspace::HS_LANES
