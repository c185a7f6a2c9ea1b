// SPDX-License-Identifier: Apache-2.0
#include "view/picked_pixel.h"

#include <ranges>
#include <span>

#include "halfspace/explain/history_text.h"

namespace halfspace {

namespace {

// Returns the object of the last fragment that changed the color, or an empty string.
std::string visible_object(const PixelHistory& history) {
  for (const FragmentDetail& f : history.fragments | std::views::reverse) {
    if (f.fragment.outcome >= FragmentOutcome::shaded) return f.object == "background" ? "" : f.object;
  }
  return {};
}

}  // namespace

PickedPixel picked_pixel(const std::string& title, const PreparedScene& scene, const SceneDescription& description, const glm::ivec2& pixel,
                         const Workers& workers) {
  const FrameTrace trace = trace_frame(scene, workers);
  const PixelHistory history = pixel_histories(description, scene, trace, std::span(&pixel, 1), workers)[0];
  return {.pixel = pixel, .object = visible_object(history), .history = history_text(title, history, trace)};
}

}  // namespace halfspace
