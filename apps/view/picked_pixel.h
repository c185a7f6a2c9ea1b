// SPDX-License-Identifier: Apache-2.0
//
// What was drawn at one pixel of a frame.
#pragma once

#include <string>

#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// A pixel that the user picked.
struct PickedPixel {
  glm::ivec2 pixel{0};       ///< of the window, from the upper left corner
  std::string object;        ///< name of the object that is visible there; empty: none
  std::string history;       ///< as `halfspace explain --text` prints it; empty until a frame was rendered
  bool is_outdated = false;  ///< of an earlier frame than the one that is shown
};

/// Traces a frame and returns the history of one of its pixels. `title` is its first line.
PickedPixel picked_pixel(const std::string& title, const PreparedScene& scene, const SceneDescription& description, const glm::ivec2& pixel,
                         const Workers& workers);

}  // namespace halfspace
