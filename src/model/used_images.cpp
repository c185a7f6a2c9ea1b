// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/used_images.h"

namespace halfspace::HS_LANES {

std::vector<bool> used_images(const Model& model) {
  std::vector<bool> used(model.images.size());
  for (const ModelMaterial& m : model.materials) {
    for (const auto use : kTextureUses) {
      const int texture = (m.*use).texture;
      if (texture < 0) continue;
      const int image = model.textures[static_cast<std::size_t>(texture)].image;
      if (image >= 0) used[static_cast<std::size_t>(image)] = true;
    }
  }
  return used;
}

}  // namespace halfspace::HS_LANES
