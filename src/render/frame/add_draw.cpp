// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/frame/add_draw.h"

#include "halfspace/render/frame/add_shader_draw.h"

namespace halfspace::HS_LANES {

void add_draw(Pass& pass, const PreparedDraw& draw, const DrawState& state) {
  std::visit([&](const auto& shader) { add_shader_draw(pass, shader, draw, state); }, draw.shader);
}

}  // namespace halfspace::HS_LANES
