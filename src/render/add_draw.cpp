// SPDX-License-Identifier: Apache-2.0
//
// Instantiates all scene shaders. This takes a long time to compile, so it is in a separate file.
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

void add_draw(Pass& pass, const PreparedDraw& draw, const DrawState& state) {
  std::visit([&](const auto& shader) { pass.draw(shader, draw.vertices, *draw.indices, state); }, draw.shader);
}

}  // namespace halfspace
