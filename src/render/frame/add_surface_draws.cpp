// SPDX-License-Identifier: Apache-2.0
//
// Instantiates the scene shaders for surfaces with any shading rate but phong.
#include "halfspace/render/frame/add_shader_draw_kernels.h"

namespace halfspace::HS_LANES {

template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::none, false>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::none, true>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::flat, false>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::flat, true>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::provoking, false>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::provoking, true>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::gouraud, false>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::gouraud, true>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::gouraud, true, NormalDetail::none, false>&, const PreparedDraw&,
                              const DrawState&);

}  // namespace halfspace::HS_LANES
