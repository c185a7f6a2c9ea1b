// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/frame/add_draw.h"

namespace halfspace::HS_LANES {

void add_draw(Pass& pass, const PreparedDraw& draw, const DrawState& state) {
  std::visit([&](const auto& shader) { pass.draw(shader, draw.vertices, *draw.indices, state); }, draw.shader);
}

}  // namespace halfspace::HS_LANES
