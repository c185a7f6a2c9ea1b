// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "view/overlay.h"
#if HALFSPACE_HAS_RAYS
#include "halfspace/reference/validation.h"
#endif

namespace halfspace {

#if HALFSPACE_HAS_RAYS
std::string draw_shadow_error_overlay(OverlayFrame frame) {
  constexpr int kRays = 16;  // per pixel, for area lights
  const Validation result =
      validate("view", frame.description, {frame.picture.width(), frame.picture.height(), kRays}, frame.assets, frame.workers);
  if (result.lights.empty()) return "no light of this scene casts shadows";
  frame.picture = difference_picture(result.lights.front());
  return fmt::format(
      "shadow of '{}' compared with ray tracing: red is wrongly dark, blue is wrongly lit; mean error {:.4f}; "
      "white: lit, black: in shadow, dark gray-blue: no surface",
      result.lights.front().score.light, result.lights.front().score.error);
}
#else
std::string draw_shadow_error_overlay(OverlayFrame) { return "this build has no ray tracing"; }
#endif

}  // namespace halfspace
