// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/export/embed_images.h"

#include "halfspace/core/resource_limits.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/png.h"
#include "halfspace/model/file_bytes.h"
#include "halfspace/model/write_model.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

void embed(ModelImage& image) {
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

}  // namespace

void embed_images(Model& model) {
  for (ModelImage& image : model.images) {
    try {
      embed(image);
    } catch (const LimitError&) {
      throw;
    } catch (const InputError& e) {
      model.warnings.emplace_back(e.what());
    }
  }
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
