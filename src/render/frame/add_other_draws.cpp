// SPDX-License-Identifier: Apache-2.0
//
// Instantiates the scene shaders for spheres, skies, points, lines, normals and shadow catchers.
#include "halfspace/render/frame/add_shader_draw_kernels.h"

namespace halfspace::HS_LANES {

template void add_shader_draw(Pass&, const SphereImpostor<false>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SphereImpostor<true>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const StarSky&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const EnvironmentSky&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const ColoredPrimitives&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const NormalLines&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const ShadowCatcher&, const PreparedDraw&, const DrawState&);

}  // namespace halfspace::HS_LANES
