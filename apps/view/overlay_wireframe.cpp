// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "halfspace/shading/surface/colored_primitives.h"
#include "view/overlay.h"

namespace halfspace {

namespace {

// Moves edges toward the eye, so that their own surfaces do not hide them. Depth is reversed.
constexpr DepthOffset kBehindLines{.slope = -1.5f, .constant = -4.0f};

}  // namespace

std::string draw_wireframe_overlay(OverlayFrame frame) {
  const std::array<glm::vec4, 1> color{glm::vec4(0.1f, 1.0f, 0.3f, 1.0f)};
  ColorTarget target = srgb8a8_target(frame.picture);
  target.load = LoadOp::load;
  Pass pass(frame.picture.width(), frame.picture.height(), target, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  DrawState surface = kReversedZState, lines = kReversedZState;
  surface.offset = kBehindLines;
  lines.polygon_mode = PolygonMode::line;
  for (const bool edges : {false, true}) {
    for (const PlacedMesh& mesh : frame.scene.meshes) {
      if (frame.description.objects[static_cast<std::size_t>(mesh.object)].second.shadow_only) continue;
      const ColoredPrimitives shader{glm::mat4(frame.scene.view.clip_from_world * mesh.world_from_object)};
      const auto vertices = make_vertex_view(stream(mesh.positions), per_instance(stream(std::span<const glm::vec4>(color))));
      if (edges) {
        pass.draw(shader, vertices, *mesh.indices, lines);
      } else {
        pass.draw_depth(shader, vertices, *mesh.indices, surface);
      }
    }
  }
  pass.run(frame.workers);
  return "green: visible edges of triangles";
}

}  // namespace halfspace
