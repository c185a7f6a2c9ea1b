// SPDX-License-Identifier: Apache-2.0
//
// The groups of cases, named after the groups of VK-GL-CTS.
#pragma once

#include <ostream>

#include "conformance/picture.h"

namespace halfspace::conformance {

Cases fill_rules_cases();
Cases primitives_cases();
Cases interpolation_cases();
Cases culling_cases();
Cases flatshading_cases();
Cases clipping_cases();
Cases blend_cases();
Cases depth_stencil_cases();
Cases scissor_cases();
Cases interaction_cases();
Cases polygon_offset_cases();
Cases multisample_cases();
Cases occlusion_query_cases();
Cases derivate_cases();
Cases texture_filtering_cases();
Cases texture_mipmap_cases();
Cases clears_cases();
Cases instanced_cases();
Cases primitive_restart_cases();
Cases geometry_shading_cases();
Cases tessellation_cases();
Cases cull_distance_cases();
Cases sample_variables_cases();
Cases conditional_rendering_cases();
Cases smooth_primitives_cases();
Cases viewport_array_cases();
Cases vertex_arrays_cases();
Cases fragment_outputs_cases();
Cases logic_ops_cases();
Cases layered_rendering_cases();

struct Group {
  const char* name;
  Cases (*cases)();
};
inline void PrintTo(const Group& g, std::ostream* os) { *os << g.name; }
/// All groups except the random states, which are created by number (random_state.h).
inline constexpr Group kGroups[] = {{"FillRules", fill_rules_cases},
                                    {"Primitives", primitives_cases},
                                    {"Interpolation", interpolation_cases},
                                    {"Culling", culling_cases},
                                    {"FlatShading", flatshading_cases},
                                    {"Clipping", clipping_cases},
                                    {"Blend", blend_cases},
                                    {"DepthStencil", depth_stencil_cases},
                                    {"Scissor", scissor_cases},
                                    {"Interaction", interaction_cases},
                                    {"PolygonOffset", polygon_offset_cases},
                                    {"Multisample", multisample_cases},
                                    {"OcclusionQuery", occlusion_query_cases},
                                    {"Derivate", derivate_cases},
                                    {"TextureFiltering", texture_filtering_cases},
                                    {"TextureMipmap", texture_mipmap_cases},
                                    {"Clears", clears_cases},
                                    {"Instanced", instanced_cases},
                                    {"PrimitiveRestart", primitive_restart_cases},
                                    {"GeometryShading", geometry_shading_cases},
                                    {"Tessellation", tessellation_cases},
                                    {"CullDistance", cull_distance_cases},
                                    {"SampleVariables", sample_variables_cases},
                                    {"ConditionalRendering", conditional_rendering_cases},
                                    {"SmoothPrimitives", smooth_primitives_cases},
                                    {"ViewportArrays", viewport_array_cases},
                                    {"VertexArrays", vertex_arrays_cases},
                                    {"FragmentOutputs", fragment_outputs_cases},
                                    {"LogicOps", logic_ops_cases},
                                    {"LayeredRendering", layered_rendering_cases}};

}  // namespace halfspace::conformance
