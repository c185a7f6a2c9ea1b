// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace::HS_LANES {

/// Returns a procedural Earth as an equirectangular color map (8-bit sRGB, alpha 255): continents with mountains, climate by
/// latitude and height, shaded seas, polar caps. Row 0 is the north. Everything is computed on the sphere of uv_sphere, so the left
/// and right edges match and the poles are not pinched. The result depends only on the size, bit for bit. width, height ≥ 1.
Image<glm::u8vec4> procedural_earth(int width, int height, const Workers& workers);

/// Returns the matching heights, from 0 at sea level to 1 for the highest mountains. They depend only on the size, bit for bit.
Image<float> procedural_earth_heights(int width, int height, const Workers& workers);

/// Both maps, bit-identical to the results of the functions above. Computing them together costs little more than computing one.
struct EarthMaps {
  Image<glm::u8vec4> color;
  Image<float> height;
};
EarthMaps procedural_earth_maps(int width, int height, const Workers& workers);

/// Returns a tangent-space normal map, (n/2 + 1/2, 1) in the frame (east, north, up), for a unit sphere displaced by 0.02 times the
/// heights. The map has the size of the height map; heights are smoothed by one texel.
Image<glm::vec4> procedural_earth_normals(const Image<float>& heights, const Workers& workers);

}  // namespace halfspace::HS_LANES
