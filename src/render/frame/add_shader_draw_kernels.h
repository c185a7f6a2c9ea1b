// SPDX-License-Identifier: Apache-2.0
//
// The definition of add_shader_draw(), for the files that instantiate it.
#pragma once

#include "halfspace/render/frame/add_shader_draw.h"

namespace halfspace::HS_LANES {

template <class S>
void add_shader_draw(Pass& pass, const S& shader, const PreparedDraw& draw, const DrawState& state) {
  pass.draw(shader, draw.vertices, *draw.indices, state);
}

}  // namespace halfspace::HS_LANES
