// SPDX-License-Identifier: Apache-2.0
//
// Procedural skies as the six faces of a cube map, in the face order and orientation of shading/environment/environment.h. In map space, z
// points forward, which is −z in world space. Values are linear; 1 is the radiance of a white surface in the noon sun.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace::HS_LANES {

using SkyFaces = std::array<Image<glm::vec4>, 6>;

struct DaySky {
  glm::vec3 sun_ms{0, 1, 0};  ///< unit vector; a lower sun makes the sky redder and darker
  float clouds = 0.4f;        ///< from 0 (none) to 1 (overcast)
};
struct NightSky {
  float milky_way = 1.0f;  ///< brightness factor
};

/// Returns a blue sky that pales towards the horizon, with the sun and its glow, clouds, and a hazy ground. Away from the sun its
/// luminance is 0.2 to 2. The result depends only on the arguments, bit for bit. size ≥ 1 is the width of a face in texels.
SkyFaces procedural_day_sky(int size, const DaySky& sky, const Workers& workers);

/// Returns a dark blue sky with the Milky Way and ground. It has no stars, because StarSky draws them more sharply than a map could. Its
/// luminance is 1e-3 to 1e-2.
SkyFaces procedural_night_sky(int size, const NightSky& sky, const Workers& workers);

/// Returns a neutral photo studio for product pictures: gray walls, a dark floor, a large soft light above and two at the sides. The
/// luminance is 0.1 to 6.
SkyFaces procedural_studio(int size, const Workers& workers);

}  // namespace halfspace::HS_LANES
