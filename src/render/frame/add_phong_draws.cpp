// SPDX-License-Identifier: Apache-2.0
//
// Instantiates the scene shaders for surfaces with the shading rate phong.
#include "halfspace/render/frame/add_shader_draw_kernels.h"

namespace halfspace::HS_LANES {

template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::phong, false>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::phong, true>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::phong, true, NormalDetail::map>&, const PreparedDraw&,
                              const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::phong, true, NormalDetail::bump>&, const PreparedDraw&,
                              const DrawState&);
template void add_shader_draw(Pass&, const SurfaceShader<ShadingRate::phong, true, NormalDetail::slopes>&, const PreparedDraw&,
                              const DrawState&);

}  // namespace halfspace::HS_LANES
