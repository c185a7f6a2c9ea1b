// SPDX-License-Identifier: Apache-2.0
//
// Computes the images that ModelImage::converted describes from their sources.
#pragma once

#include <string>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// The two results of a conversion, of the same size.
struct ConvertedImages {
  Image<glm::u8vec4> base_color;          ///< sRGB; alpha is that of the diffuse texture
  Image<glm::u8vec4> metallic_roughness;  ///< linear: roughness in green, metalness in blue
  std::vector<std::string> problems;      ///< sources that cannot be read; they are replaced by white

  /// Returns the one that an image of the model stands for.
  const Image<glm::u8vec4>& result(const ModelImage& image) const {
    return image.converted->result == SpecularGlossiness::Result::base_color ? base_color : metallic_roughness;
  }
};

/// Converts textures of a model. The results have the size of the source with more texels; the other one is resampled with its wrap modes,
/// in linear light. place: begins the error messages of embedded images. Throws LimitError.
ConvertedImages converted_images(const Model& model, const SpecularGlossiness& source, const std::string& place, const Workers& workers);

}  // namespace halfspace::HS_LANES
