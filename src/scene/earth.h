// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "core/image.h"
#include "core/parallel.h"
#include "raster/statistics.h"

namespace halfspace {

struct EarthOptions {
  int width = 1920;
  int height = 1080;
  std::filesystem::path color_map;  ///< equirectangular, 8-bit sRGB codes; empty: procedural_earth
};

struct RenderResult {
  Image<glm::u8vec4> image;  ///< 8-bit sRGB codes, top row first
  PassStatistics statistics;
};

/// Renders the scene "earth". Throws InputError where the colour map cannot be used.
RenderResult render_earth(const EarthOptions& options, const Workers& workers);

}  // namespace halfspace
