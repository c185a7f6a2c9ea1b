// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/normal_lines.h"

#include "halfspace/geometry/camera.h"
#include "halfspace/render/prepare/wireframe.h"

namespace halfspace::HS_LANES {

PreparedDraw normal_lines(const DrawSource& mesh, const std::shared_ptr<const Indices>& indices, const View& view, double length) {
  const glm::dmat4& world = mesh.world_from_object;
  const NormalLines shader{.clip_from_object = glm::mat4(view.clip_from_world * world),
                           .clip_from_world = glm::mat4(view.clip_from_world),
                           .normal_from_object = normal_matrix(world),
                           .length = static_cast<float>(length)};
  DrawState state = opaque_state(CullMode::none, false);
  state.line_width = line_width(view);
  return {shader,
          make_vertex_view(mesh.streams.position_stream(), mesh.streams.normal_stream()),
          indices,
          state,
          {mesh.object, mesh.instance, {}, world}};
}

}  // namespace halfspace::HS_LANES
