// SPDX-License-Identifier: Apache-2.0
//
// The scene "earth": a textured globe under one light, Blinn-Phong per pixel.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>

#include "core/image.h"
#include "core/parallel.h"
#include "raster/draw_state.h"
#include "raster/statistics.h"
#include "scene/mesh.h"
#include "shading/blinn_phong.h"

namespace halfspace {

struct EarthOptions {
  int width = 1920;                   ///< px
  int height = 1080;                  ///< px
  std::filesystem::path color_map{};  ///< equirectangular, 8-bit sRGB codes; empty: procedural_earth
  glm::dvec3 eye{0.0, 0.55, 2.75};    ///< world units; the globe has radius 1 and sits at the origin
  double meridian = 20.0;             ///< degrees east that face +z
};

/// All that a draw of the globe needs. The shader points to map: keep them together.
struct EarthScene {
  Texture2D map;
  Mesh globe;
  BlinnPhong shader;
  DrawState state;        ///< reversed Z: clear depth to 0
  glm::vec4 clear_color;  ///< linear
};

struct RenderResult {
  Image<glm::u8vec4> image;  ///< 8-bit sRGB codes, top row first
  PassStatistics statistics;
};

/// Throws InputError where the colour map cannot be used.
std::unique_ptr<EarthScene> make_earth(const EarthOptions& options, const Workers& workers);

/// Renders the scene. Throws as make_earth.
RenderResult render_earth(const EarthOptions& options, const Workers& workers);

}  // namespace halfspace
