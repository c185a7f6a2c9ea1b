// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/wireframe.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "halfspace/core/float_mode.h"

namespace halfspace::HS_LANES {

namespace {

using Palette = std::array<glm::vec4, 1>;

enum class DrawKind { mesh, sphere, other };

template <class S>
constexpr bool kIsSphereShader = std::is_same_v<S, SphereImpostor<false>> || std::is_same_v<S, SphereImpostor<true>>;
template <class S>
constexpr bool kIsMeshlessShader = std::is_same_v<S, StarSky> || std::is_same_v<S, EnvironmentSky> ||
                                   std::is_same_v<S, ColoredPrimitives> || std::is_same_v<S, NormalLines>;

DrawKind kind_of(const PreparedDraw& draw) {
  return std::visit(
      []<class S>(const S&) {
        if constexpr (kIsSphereShader<S>) return DrawKind::sphere;
        return kIsMeshlessShader<S> ? DrawKind::other : DrawKind::mesh;
      },
      draw.shader);
}

// Draws the triangles of a mesh in one color. `color` must outlive the draw.
PreparedDraw plain_draw(const PlacedMesh& mesh, const View& view, const Palette& color, const DrawState& state) {
  const ColoredPrimitives shader{glm::mat4(view.clip_from_world * mesh.world_from_object)};
  return {shader,
          make_vertex_view(stream(mesh.positions), per_instance(stream(std::span<const glm::vec4>(color)))),
          mesh.indices,
          state,
          {mesh.object, 0, {mesh.positions, mesh.normals, {}, {}, {}, {}}, mesh.world_from_object}};
}

// Moves surfaces away from the eye, so that they do not hide their own edges. Depth is reversed. The center of a pixel on a line can be
// half a pixel beyond the edge.
constexpr DepthOffset kBehindEdges{.slope = -1.5f, .constant = -4.0f};

}  // namespace

glm::vec4 line_color(const glm::vec4& background) {
  const float luminance = 0.2126f * background.x + 0.7152f * background.y + 0.0722f * background.z;
  constexpr float kMiddle = 0.18f;
  return luminance > kMiddle ? glm::vec4(0, 0, 0, 1) : glm::vec4(1.0f);
}

float line_width(const View& view) { return std::max(1.0f, static_cast<float>(view.height_px) / 1080.0f); }

bool make_wireframe(PreparedScene& scene, const SceneDescription& description, HiddenLines hidden) {
  const FloatMode float_mode;
  const auto colors = std::make_shared<const std::array<Palette, 2>>(
      std::array<Palette, 2>{Palette{line_color(scene.clear_color)}, Palette{scene.clear_color}});
  scene.assets.push_back(colors);
  DrawState lines = opaque_state(CullMode::none, false), surface = lines;
  lines.polygon_mode = PolygonMode::line;
  lines.line_width = line_width(scene.view);
  surface.offset = kBehindEdges;
  std::vector<PreparedDraw> draws;
  for (const PlacedMesh& mesh : scene.meshes) {
    if (description.objects[static_cast<std::size_t>(mesh.object)].second.shadow_only) continue;
    if (hidden == HiddenLines::removed) draws.push_back(plain_draw(mesh, scene.view, (*colors)[1], surface));
    draws.push_back(plain_draw(mesh, scene.view, (*colors)[0], lines));
  }
  bool has_spheres = false;
  for (PreparedDraw& draw : scene.draws) {
    const DrawKind kind = kind_of(draw);
    has_spheres |= kind == DrawKind::sphere;
    if (kind != DrawKind::mesh) draws.push_back(std::move(draw));
  }
  scene.draws = std::move(draws);
  scene.post.tone_unlit = true;  // surfaces have to match the background
  return has_spheres;
}

}  // namespace halfspace::HS_LANES
