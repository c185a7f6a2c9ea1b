// SPDX-License-Identifier: Apache-2.0
//
// Pictures of the values in a frame that stages exchange.
#pragma once

#include "halfspace/core/image.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// Returns the window depth of the visible surfaces (sample 0), as the pass stores it: 1 is near, 0 is far.
Image<float> depth_buffer(const PreparedScene& scene, const Workers& workers);

/// Values of the opaque surface at each pixel; 0 with alpha 0 where there is none.
struct ValuePictures {
  Image<glm::vec3> normal, position, albedo;
  Image<glm::vec2> uv;
  Image<uint32_t> object, instance, triangle;
  Image<glm::vec3> barycentrics;
};
ValuePictures value_pictures(const PreparedScene& scene, const Workers& workers);

/// The look-up of the color map at a pixel.
struct MipLookup {
  float lod = 0;                   ///< level of detail; negative: the map is magnified
  float probes = 0;                ///< number of probes of an anisotropic look-up; 0: there is no map here
  float scale_x = 0, scale_y = 0;  ///< steps in texels of level 0 to the next pixel to the right and up
};
/// Returns the look-ups of the color maps of all opaque surfaces.
Image<MipLookup> mip_levels(const PreparedScene& scene, const Workers& workers);

}  // namespace halfspace
