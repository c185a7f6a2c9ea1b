// SPDX-License-Identifier: Apache-2.0
//
// Overlays: visualizations that are drawn over a frame.
#pragma once

#include <optional>
#include <string>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace {

enum class Overlay : uint8_t { none, wireframe, overdraw, tiles, mip_levels, normals, shadow_error };
inline constexpr std::size_t kOverlays = 7;

const char* name_of(Overlay overlay);

/// Returns the next or the previous overlay. Builds without ray tracing do not have shadow_error.
Overlay next_overlay(Overlay overlay, bool backwards);

/// A frame that an overlay is drawn over.
struct OverlayFrame {
  const SceneDescription& description;
  const PreparedScene& scene;
  Image<glm::u8vec4>& picture;  ///< has the size that the scene was prepared for
  SceneAssets& assets;
  const Workers& workers;
};

/// Draws the overlay. Returns a line of text that explains its colors.
std::string draw_overlay(Overlay overlay, OverlayFrame frame);

// The overlays, one source file for each group.
std::string draw_wireframe_overlay(OverlayFrame frame);     ///< visible edges of triangles, in green
std::string draw_overdraw_overlay(OverlayFrame frame);      ///< number of fragments of each pixel, without a depth test
std::string draw_tiles_overlay(OverlayFrame frame);         ///< number of primitives in the bin of each tile
std::string draw_mip_level_overlay(OverlayFrame frame);     ///< mip level of the color map at each pixel
std::string draw_normals_overlay(OverlayFrame frame);       ///< normals used for lighting, in world space
std::string draw_shadow_error_overlay(OverlayFrame frame);  ///< errors of the first light's shadows, compared with ray tracing

/// Returns a color for a number in [0, 1]: from dark blue through green and yellow to white.
glm::u8vec4 heat_color(double value);

}  // namespace halfspace
