// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace {

/// An invented Earth as an equirectangular colour map (8-bit sRGB codes, alpha 255): continents with mountains,
/// climate by latitude and height, tinted seas, polar caps. Row 0 is the north, the left and right edge meet, and the
/// poles are not pinched, because everything is computed on the sphere of uv_sphere. The bits depend on the size
/// alone. width, height ≥ 1.
Image<glm::u8vec4> procedural_earth(int width, int height, const Workers& workers);

/// The heights that belong to it: 0 the sea, 1 the highest mountains; not coded. Bits as above.
Image<float> procedural_earth_heights(int width, int height, const Workers& workers);

/// Both, with the same bits, for little more than one of them costs.
struct EarthMaps {
  Image<glm::u8vec4> color;
  Image<float> height;
};
EarthMaps procedural_earth_maps(int width, int height, const Workers& workers);

/// Normals of the sphere of radius 1 that such heights raise by up to 0.02, coded for a normal map: (n/2 + 1/2, 1) in the frame
/// (east, north, up). As wide and high as the heights, smoothed by a texel.
Image<glm::vec4> procedural_earth_normals(const Image<float>& heights, const Workers& workers);

}  // namespace halfspace
