// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "halfspace/model/gltf/gltf_draco.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::array<std::string_view, 19> kSupported = {
    "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",         "EXT_texture_webp",           "KHR_lights_punctual",
    "KHR_materials_clearcoat", "KHR_materials_emissive_strength", "KHR_materials_ior",          "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",     "KHR_materials_specular",          "KHR_materials_transmission", "KHR_materials_unlit",
    "KHR_materials_variants",  "KHR_mesh_quantization",           "KHR_texture_transform",      "KHR_node_visibility",
    "MSFT_texture_dds",
    "KHR_animation_pointer",  // to properties of nodes
    "KHR_xmp_json_ld",        // metadata, which has no effect
};

// A file that requires one of these extensions is drawn without it. Missing material extensions also affect only the appearance.
constexpr std::array<std::string_view, 5> kAppearance = {
    "EXT_lights_ies", "EXT_lights_image_based", "EXT_texture_avif", "KHR_texture_basisu", "KHR_texture_procedurals",
};

constexpr std::string_view kDracoExtension = "KHR_draco_mesh_compression";

bool is_supported(std::string_view name) {
  return name == kDracoExtension ? can_decode_draco() : std::ranges::find(kSupported, name) != kSupported.end();
}

bool changes_only_appearance(std::string_view name) {
  return name.find("_materials_") != std::string_view::npos || std::ranges::find(kAppearance, name) != kAppearance.end();
}

}  // namespace

void read_gltf_extensions(GltfDocument& document, Model& model) {
  const auto name_of = [&](const GltfValue& item) {
    if (!item.is_string()) document.fail(item, "wrong type; expected the name of an extension");
    return item.get<std::string>();
  };
  for (const GltfValue& item : document.array(document.root(), "extensionsRequired")) {
    const std::string name = name_of(item);
    if (!is_supported(name) && !changes_only_appearance(name)) {
      const char* problem = name == kDracoExtension
                                ? "whose decoder, halfspace-draco-tool, is not installed; expected the decoder to be installed"
                                : "which is not supported; expected a file without it";
      document.fail(item, fmt::format("the file requires the extension {}, {}", gltf_quoted(name), problem));
    }
  }
  for (const GltfValue& item : document.array(document.root(), "extensionsUsed")) {
    model.extensions.push_back(name_of(item));
    if (!is_supported(model.extensions.back())) {
      model.unsupported_extensions.push_back(model.extensions.back());
      document.warn("the extension " + gltf_quoted(model.extensions.back()) + " is not supported; the model is read without it");
    }
  }
}

}  // namespace halfspace::HS_LANES
