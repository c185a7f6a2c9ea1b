// SPDX-License-Identifier: Apache-2.0
#include "view/picked_pixel.h"

#include <algorithm>
#include <span>

#include "explain/history_text.h"

namespace halfspace {

namespace {

// Returns the object of the last fragment that changed the color, or an empty string.
std::string visible_object(const PixelHistory& history) {
  const auto changed = [](const FragmentDetail& f) { return f.fragment.outcome >= FragmentOutcome::shaded; };
  const auto last = std::find_if(history.fragments.rbegin(), history.fragments.rend(), changed);
  return last == history.fragments.rend() || last->object == "background" ? "" : last->object;
}

}  // namespace

PickedPixel picked_pixel(const std::string& title, const PreparedScene& scene, const SceneDescription& description, const glm::ivec2& pixel,
                         const Workers& workers) {
  const FrameTrace trace = trace_frame(scene, workers);
  const PixelHistory history = pixel_histories(description, scene, trace, std::span(&pixel, 1), workers)[0];
  return {.pixel = pixel, .object = visible_object(history), .history = history_text(title, history, trace)};
}

}  // namespace halfspace
