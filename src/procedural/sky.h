// SPDX-License-Identifier: Apache-2.0
//
// Skies made by the program, as the six faces of a cube in the order and directions of shading/environment.h (map space:
// z ahead, which is −z of the world). Linear light; 1 is what a white surface in the noon sun sends back.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace {

using SkyFaces = std::array<Image<glm::vec4>, 6>;

struct DaySky {
  glm::vec3 sun_ms{0, 1, 0};  ///< unit vector; the lower it is, the redder and darker the sky
  float clouds = 0.4f;        ///< 0 none to 1 overcast
};
struct NightSky {
  float milky_way = 1.0f;  ///< factor of its light
};

/// Blue that pales towards the horizon, glow and disc of the sun, clouds, and hazy ground below. Its luminance is 0.2 to 2 away
/// from the sun. The bits depend on the arguments alone. size >= 1: texels along a face.
SkyFaces procedural_day_sky(int size, const DaySky& sky, const Workers& workers);

/// Dark blue, the Milky Way and ground; no stars, which StarSky has sharper. Luminance 1e-3 to 1e-2.
SkyFaces procedural_night_sky(int size, const NightSky& sky, const Workers& workers);

}  // namespace halfspace
