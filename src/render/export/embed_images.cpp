// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/export/embed_images.h"

#include "halfspace/core/resource_limits.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/png.h"
#include "halfspace/model/file_bytes.h"
#include "halfspace/model/used_images.h"
#include "halfspace/model/write_model.h"
#include "halfspace/render/converted_images.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

void embed_converted(Model& model, ModelImage& image) {
  const Workers workers(1);
  const ConvertedImages images = converted_images(model, *image.converted, image.name, workers);
  const bool is_color = image.converted->result == SpecularGlossiness::Result::base_color;
  image.bytes = std::make_shared<const std::vector<std::byte>>(is_color ? encode_png(images.base_color)
                                                                        : encode_png(images.metallic_roughness, PngCodes::numbers));
  // Both results report the same problems.
  if (is_color) model.warnings.insert(model.warnings.end(), images.problems.begin(), images.problems.end());
}

void embed(Model& model, ModelImage& image) {
  if (image.converted) return embed_converted(model, image);
  if (image.pixels) {
    image.bytes = std::make_shared<const std::vector<std::byte>>(encode_png(*image.pixels));
    return;
  }
  if (image.bytes == nullptr && image.file.empty()) return;  // the reader has already warned
  const auto own = [](std::vector<std::byte> bytes) { return std::make_shared<const std::vector<std::byte>>(std::move(bytes)); };
  auto bytes = image.bytes != nullptr ? image.bytes : own(file_bytes(image.file, memory_left()));
  if (image_extension(*bytes).empty()) bytes = own(encode_png(read_image(*bytes, image.name)));
  image.bytes = std::move(bytes);
}

// Removes the images that were only needed to compute others.
void remove_sources(Model& model) {
  const std::vector<bool> used = used_images(model);
  for (const ModelImage& image : model.images) {
    if (!image.converted) continue;
    for (const int texture : {image.converted->diffuse_texture, image.converted->specular_texture}) {
      const int source = texture < 0 ? -1 : model.textures[static_cast<std::size_t>(texture)].image;
      if (source < 0 || used[static_cast<std::size_t>(source)]) continue;
      ModelImage& unneeded = model.images[static_cast<std::size_t>(source)];
      unneeded.file.clear();
      unneeded.bytes = nullptr;
      unneeded.pixels = nullptr;
    }
  }
}

}  // namespace

void embed_images(Model& model) {
  for (ModelImage& image : model.images) {
    try {
      embed(model, image);
    } catch (const LimitError&) {
      throw;
    } catch (const InputError& e) {
      model.warnings.emplace_back(e.what());
    }
  }
  remove_sources(model);
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
