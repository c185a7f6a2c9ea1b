// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/used_images.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

std::vector<bool> used_images(const Model& model) {
  std::vector<bool> used(model.images.size());
  for (const ModelMaterial& m : model.materials) {
    for (const TextureUse* use :
         {&m.base_color_map, &m.opacity_map, &m.metallic_map, &m.roughness_map, &m.specular_map, &m.specular_color_map, &m.clearcoat_map,
          &m.clearcoat_roughness_map, &m.clearcoat_normal_map, &m.normal_map, &m.bump_map, &m.occlusion_map, &m.emissive_map}) {
      if (use->texture < 0) continue;
      const int image = model.textures[static_cast<std::size_t>(use->texture)].image;
      if (image >= 0) used[static_cast<std::size_t>(image)] = true;
    }
  }
  return used;
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
