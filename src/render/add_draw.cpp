// SPDX-License-Identifier: Apache-2.0
//
// Where the shaders of scenes are compiled: a file of its own, for it takes long.
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

void add_draw(Pass& pass, const PreparedDraw& draw) {
  std::visit([&](const auto& shader) { pass.draw(shader, draw.vertices, *draw.indices, draw.state); }, draw.shader);
}

}  // namespace halfspace
