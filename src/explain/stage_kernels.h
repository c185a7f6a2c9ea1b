// SPDX-License-Identifier: Apache-2.0
//
// The vertex functions of the shaders of a scene, for the stages before shading.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// Returns the kernels of a shader that the stages up to binning use: the vertex function without its varyings. The object is static.
const ShaderKernels& geometry_kernels(const SceneShader& shader);

/// Returns the address of the shader in the variant.
const void* shader_address(const SceneShader& shader);

}  // namespace halfspace
