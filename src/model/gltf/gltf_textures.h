// SPDX-License-Identifier: Apache-2.0
//
// Images, samplers and textures of glTF files.
#pragma once

#include <array>
#include <map>

#include "halfspace/model/gltf/gltf_buffers.h"
#include "halfspace/model/gltf/gltf_document.h"
#include "halfspace/model/model.h"
#include "halfspace/model/text/references.h"

namespace halfspace::HS_LANES {

/// Reads the textures that materials use. All arguments of the constructor must outlive this object.
class GltfTextures {
 public:
  /// Adds one ModelTexture per texture and one ModelImage per image to the model. Images are only located if a material uses them; other
  /// images have neither a file nor bytes.
  GltfTextures(GltfDocument& document, GltfBuffers& buffers, References& references, Model& model);

  /// Reads the texture that a member of an object describes, including KHR_texture_transform. Returns a TextureUse without a texture if the
  /// member is missing or if its image does not exist.
  TextureUse use(const GltfValue& object, const char* key, Channel channel = Channel::red);

  /// Adds the two images that result from a conversion of textures, and a texture for each, unless the same conversion was added before.
  /// Returns the number of the texture with the base color; the next one is the texture with metalness and roughness. name: of the
  /// material.
  int add_converted(const SpecularGlossiness& source, const std::string& name);

 private:
  bool locate_image(int image);

  GltfDocument& document_;
  GltfBuffers& buffers_;
  References& references_;
  Model& model_;
  std::vector<bool> tried_;                        // for each image of the file, whether locate_image was called
  std::map<std::array<float, 9>, int> converted_;  // the results of add_converted
};

}  // namespace halfspace::HS_LANES
