// SPDX-License-Identifier: Apache-2.0
//
// Overlays: pictures of what the renderer does, drawn over a frame.
#pragma once

#include <optional>
#include <string>

#include "halfspace/render/prepared_scene.h"

namespace halfspace {

enum class Overlay : uint8_t { none, wireframe, overdraw, tiles, mip_levels, normals, shadow_error };
inline constexpr std::size_t kOverlays = 7;

const char* name_of(Overlay overlay);

/// Returns the overlay after this one, or before it. Builds without ray tracing have no shadow_error.
Overlay next_overlay(Overlay overlay, bool backwards);

/// A frame that an overlay is drawn over.
struct OverlayFrame {
  const SceneDescription& description;
  const PreparedScene& scene;
  Image<glm::u8vec4>& picture;  ///< of the size for which the scene was prepared
  SceneAssets& assets;
  const Workers& workers;
};

/// Draws the overlay. Returns a line that explains its colors.
std::string draw_overlay(Overlay overlay, OverlayFrame frame);

// The overlays, one source file for each group.
std::string draw_wireframe_overlay(OverlayFrame frame);     ///< edges of triangles; green, behind surfaces darker
std::string draw_overdraw_overlay(OverlayFrame frame);      ///< number of fragments of each pixel, without a depth test
std::string draw_tiles_overlay(OverlayFrame frame);         ///< number of triangles whose bounds reach each tile
std::string draw_mip_level_overlay(OverlayFrame frame);     ///< level of the color map that the footprint of a pixel selects
std::string draw_normals_overlay(OverlayFrame frame);       ///< normals that lighting uses, in world space
std::string draw_shadow_error_overlay(OverlayFrame frame);  ///< shadow of the first light compared with ray casting

/// Returns a color for a number in [0, 1]: from dark blue over green and yellow to white.
glm::u8vec4 heat_color(double value);

}  // namespace halfspace
