// SPDX-License-Identifier: Apache-2.0
//
// Instantiates the scene shaders for metallic-roughness materials without normal maps.
#include "halfspace/render/frame/add_shader_draw_kernels.h"

namespace halfspace::HS_LANES {

template void add_shader_draw(Pass&, const MetallicSurface<MetallicStreams::basic>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const MetallicSurface<MetallicStreams::colored>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const MetallicSurface<MetallicStreams::mapped>&, const PreparedDraw&, const DrawState&);
template void add_shader_draw(Pass&, const MetallicSurface<MetallicStreams::mapped, true>&, const PreparedDraw&, const DrawState&);

}  // namespace halfspace::HS_LANES
