// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/model/gltf/gltf_document.h"
#include "halfspace/model/gltf/gltf_textures.h"
#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Returns the materials of a glTF file, with the extensions KHR_materials_unlit, emissive_strength, specular, ior, clearcoat, sheen,
/// transmission (approximated by blending) and pbrSpecularGlossiness (converted).
std::vector<ModelMaterial> gltf_materials(GltfDocument& document, GltfTextures& textures);

/// Returns the default material, which is used by primitives that do not name one. glTF defines it as a rough white metal.
ModelMaterial gltf_default_material();

}  // namespace halfspace::HS_LANES
