// SPDX-License-Identifier: Apache-2.0
//
// Pictures of intermediate values of a frame: depth, surface values and mip levels.
#pragma once

#include <vector>

#include "explain/pixel_history.h"
#include "halfspace/core/image.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// Returns the stored window depth of sample 0 of each pixel: 1 is near, 0 is far.
Image<float> depth_buffer(const PreparedScene& scene, const Workers& workers);

/// The smallest and the largest depth stored in each block of 8x8 pixels, over all samples. Row by row from the lower left.
struct DepthBlocks {
  int columns = 0, rows = 0;
  std::vector<float> low, high;
};
DepthBlocks depth_blocks(const PreparedScene& scene, const FrameTrace& trace);

/// Values of the opaque surface at each pixel; 0 with alpha 0 where there is none.
struct ValuePictures {
  Image<glm::vec3> normal, position, albedo;
  Image<glm::vec2> uv;
  Image<uint32_t> object, instance, triangle;
  Image<glm::vec3> barycentrics;
};
ValuePictures value_pictures(const PreparedScene& scene, const Workers& workers);

/// The lookup in the color map at a pixel.
struct MipLookup {
  float lod = 0;     ///< level of detail; negative if the map is magnified
  float probes = 0;  ///< number of probes of an anisotropic lookup; 0 if the surface has no color map
  bool is_anisotropic = false;
  /// In texels of level 0. Anisotropic: the major and the minor axis of the footprint (shading/texture/footprint.h). Otherwise, the
  /// distances to the next pixel to the right and up.
  glm::vec2 axes{0.0f};
};
/// Returns the lookup in the color map of the opaque surface at each pixel.
Image<MipLookup> mip_levels(const PreparedScene& scene, const Workers& workers);

}  // namespace halfspace
