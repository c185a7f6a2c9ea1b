// SPDX-License-Identifier: Apache-2.0
//
// Instantiates the vertex functions of all scene shaders.
#include "halfspace/explain/stage_kernels.h"

#include "halfspace/raster/primitives/vertex_kernel.h"

namespace halfspace {

namespace {

template <class S>
constexpr ShaderKernels geometry_kernels_of() {
  ShaderKernels k;
  k.vertex = detail::vertex_kernel<S, false, true>;
  k.position = detail::vertex_kernel<S, false, false>;
  k.gives_point_size = kGivesPointSize<S>;
  k.gives_point_sprite = kGivesPointSprite<S>;
  k.clip_distance_count = static_cast<int>(kClipDistances<S>);
  return k;
}
template <class S>
constexpr ShaderKernels kGeometryKernels = geometry_kernels_of<S>();

}  // namespace

const ShaderKernels& geometry_kernels(const SceneShader& shader) {
  return std::visit([]<class S>(const S&) -> const ShaderKernels& { return kGeometryKernels<S>; }, shader);
}

const void* shader_address(const SceneShader& shader) {
  return std::visit([](const auto& s) -> const void* { return &s; }, shader);
}

}  // namespace halfspace
