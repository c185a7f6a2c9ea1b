// SPDX-License-Identifier: Apache-2.0
//
// Adds a draw with a known type of shader. Kernels take long to compile, so several translation units instantiate the function:
// add_surface_draws.cpp, add_phong_draws.cpp, add_metallic_draws.cpp, add_detailed_metallic_draws.cpp and add_other_draws.cpp.
#pragma once

#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// shader: draw.shader, with its type.
template <class S>
void add_shader_draw(Pass& pass, const S& shader, const PreparedDraw& draw, const DrawState& state);

}  // namespace halfspace::HS_LANES
