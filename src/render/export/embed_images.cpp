// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/export/embed_images.h"

#include <algorithm>
#include <deque>
#include <map>

#include "halfspace/core/resource_limits.h"
#include "halfspace/image/png.h"
#include "halfspace/model/gltf/specular_glossiness.h"
#include "halfspace/model/text/file_bytes.h"
#include "halfspace/model/used_images.h"
#include "halfspace/model/write_model.h"
#include "halfspace/model/written_model.h"
#include "halfspace/render/assets/converted_images.h"
#include "halfspace/render/assets/texture_image.h"
#include "halfspace/render/export/scene_materials.h"

namespace halfspace::HS_LANES {

namespace {

std::shared_ptr<const std::vector<std::byte>> shared(std::vector<std::byte> bytes) {
  return std::make_shared<const std::vector<std::byte>>(std::move(bytes));
}

bool can_be_textured(const ModelMesh& mesh) { return mesh.topology == MeshTopology::triangles && !mesh.uvs[0].empty(); }

// Returns all references of a mesh to materials.
std::vector<int*> materials_of(ModelMesh& mesh) {
  std::vector<int*> materials{&mesh.material};
  for (int& material : mesh.variant_materials) materials.push_back(&material);
  std::erase_if(materials, [](const int* material) { return *material < 0; });
  return materials;
}

// Replaces converted maps by their factors in materials that no mesh can be textured with. If other meshes share a material with such
// meshes, they get a copy.
void remove_unusable_conversions(Model& model) {
  std::vector<bool> usable(model.materials.size());
  for (ModelMesh& mesh : model.meshes) {
    for (const int* material : materials_of(mesh)) {
      if (can_be_textured(mesh)) usable[static_cast<std::size_t>(*material)] = true;
    }
  }
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (!usable[i]) model.materials[i] = without_converted_maps(model, model.materials[i]);
  }
  std::map<int, int> copies;
  for (ModelMesh& mesh : model.meshes) {
    if (can_be_textured(mesh)) continue;
    for (int* material : materials_of(mesh)) {
      const ModelMaterial& shared_material = model.materials[static_cast<std::size_t>(*material)];
      if (!has_converted_maps(model, shared_material)) continue;
      const auto [copy, added] = copies.try_emplace(*material, static_cast<int>(model.materials.size()));
      if (added) model.materials.push_back(without_converted_maps(model, shared_material));
      *material = copy->second;
    }
  }
}

// Runs each conversion once, for all images that result from it. The results count towards the memory limit with their size before
// compression, so that the limit also bounds the time.
void embed_conversions(Model& model, const std::vector<bool>& used, const std::string& file) {
  const Workers workers(1);
  std::deque<MemoryClaim> claims;
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    if (!used[i] || !model.images[i].converted) continue;
    const ModelImage first = model.images[i];
    const ConvertedImages results = converted_images(model, *first.converted, file, workers);
    claims.emplace_back(2 * sizeof(glm::u8vec4) * results.base_color.texels().size(), file);
    for (const std::string& problem : results.problems) warn_once(model, problem);
    for (std::size_t k = i; k < model.images.size() && are_converted_together(first, model.images[k]); ++k) {
      ModelImage& image = model.images[k];
      const bool is_color = image.converted->result == SpecularGlossiness::Result::base_color;
      if (used[k]) image.bytes = shared(encode_png(results.result(image), is_color ? PngCodes::srgb : PngCodes::numbers));
      image.converted.reset();
    }
  }
}

// Returns the role of each image. An image with several roles has the first of colors, data and normals.
std::vector<TextureRole> image_roles(const Model& model) {
  std::vector<TextureRole> roles(model.images.size(), TextureRole::normals);
  for (const ModelMaterial& m : model.materials) {
    for (const auto map : kTextureUses) {
      const int texture = (m.*map).texture;
      const int image = texture < 0 ? -1 : model.textures[static_cast<std::size_t>(texture)].image;
      if (image >= 0) roles[static_cast<std::size_t>(image)] = std::min(roles[static_cast<std::size_t>(image)], role_of(map));
    }
  }
  return roles;
}

// Embeds the file of an image if models can contain its format, otherwise a PNG with the same texels.
void embed(Model& model, ModelImage& image, TextureRole role, const std::string& file) {
  if (!image.has_content()) return;  // the reader has already warned
  if (image.pixels == nullptr) {
    const auto bytes = image.bytes != nullptr ? image.bytes : shared(file_bytes(image.file, memory_left()));
    if (!image_extension(*bytes).empty()) {
      image.bytes = bytes;
      return;
    }
  }
  const TextureImage texels = texels_of(image, role, file);
  warn_if_clamped(model, texels);
  image.bytes = shared(encode_png(texels, image_use(role)));
}

void embed_used(Model& model, const std::vector<bool>& used, const std::string& file) {
  const std::vector<TextureRole> roles = image_roles(model);
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    if (!used[i]) {
      model.images[i] = {.name = std::move(model.images[i].name), .file = {}, .bytes = nullptr};
      continue;
    }
    try {
      embed(model, model.images[i], roles[i], file);
    } catch (const LimitError&) {
      throw;
    } catch (const InputError& e) {
      warn_once(model, e.what());
    }
  }
}

}  // namespace

void embed_images(Model& model, const std::string& file) {
  remove_unusable_conversions(model);
  const std::vector<bool> used = used_images(model);
  embed_conversions(model, used, file);
  embed_used(model, used, file);
}

}  // namespace halfspace::HS_LANES
