// SPDX-License-Identifier: Apache-2.0
#include "view/overlay.h"

#include <algorithm>
#include <array>

namespace halfspace {

namespace {

#if HALFSPACE_HAS_RAYS
constexpr int kAvailableOverlays = kOverlays;
#else
constexpr int kAvailableOverlays = kOverlays - 1;
#endif

}  // namespace

const char* name_of(Overlay overlay) {
  static constexpr const char* kNames[kOverlays] = {
      "none", "wireframe", "overdraw", "tiles", "mip levels", "normals", "shadow map vs. ray tracing"};
  return kNames[static_cast<std::size_t>(overlay)];
}

Overlay next_overlay(Overlay overlay, bool backwards) {
  return static_cast<Overlay>((static_cast<int>(overlay) + (backwards ? kAvailableOverlays - 1 : 1)) % kAvailableOverlays);
}

std::string draw_overlay(Overlay overlay, OverlayFrame frame) {
  switch (overlay) {
    case Overlay::wireframe: return draw_wireframe_overlay(frame);
    case Overlay::overdraw: return draw_overdraw_overlay(frame);
    case Overlay::tiles: return draw_tiles_overlay(frame);
    case Overlay::mip_levels: return draw_mip_level_overlay(frame);
    case Overlay::normals: return draw_normals_overlay(frame);
    case Overlay::shadow_error: return draw_shadow_error_overlay(frame);
    case Overlay::none: break;
  }
  return {};
}

glm::u8vec4 heat_color(double value) {
  static constexpr std::array<glm::dvec3, 6> kStops{glm::dvec3{0.05, 0.03, 0.2}, {0.1, 0.25, 0.7}, {0.05, 0.6, 0.5}, {0.6, 0.75, 0.1},
                                                    {0.95, 0.45, 0.1},           {1, 1, 0.95}};
  const double place = std::clamp(value, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const glm::dvec3 color = glm::mix(kStops[i], kStops[i + 1], place - static_cast<double>(i));
  return glm::u8vec4(glm::dvec4(color * 255.0 + 0.5, 255.0));
}

}  // namespace halfspace
