// SPDX-License-Identifier: Apache-2.0
//
// Instantiates all scene shaders. They are slow to compile, so they have their own translation unit.
#include "halfspace/render/prepared_scene.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

void add_draw(Pass& pass, const PreparedDraw& draw, const DrawState& state) {
  std::visit([&](const auto& shader) { pass.draw(shader, draw.vertices, *draw.indices, state); }, draw.shader);
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
