// SPDX-License-Identifier: Apache-2.0
//
// Instantiates the scene shaders for metallic-roughness materials with normal maps.
#include "halfspace/render/frame/add_shader_draw_kernels.h"

namespace halfspace::HS_LANES {

template void add_shader_draw(Pass&, const MetallicSurface<MetallicStreams::detailed>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const MetallicSurface<MetallicStreams::detailed, true>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const MetallicSurface<MetallicStreams::full>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const MetallicSurface<MetallicStreams::full, true>&, const PreparedDraw&, const DrawState&);

}  // namespace halfspace::HS_LANES
