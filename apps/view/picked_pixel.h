// SPDX-License-Identifier: Apache-2.0
//
// The history of one pixel of a frame.
#pragma once

#include <string>

#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// A pixel that the user picked.
struct PickedPixel {
  glm::ivec2 pixel{0};       ///< position in the window, from the upper left corner
  std::string object;        ///< name of the visible object; empty if there is none
  std::string history;       ///< output of `halfspace explain --text`; empty until a frame has been rendered
  bool is_outdated = false;  ///< the history is that of an earlier frame
};

/// Traces a frame and returns the history of one of its pixels. `title` starts the first line of the history.
PickedPixel picked_pixel(const std::string& title, const PreparedScene& scene, const SceneDescription& description, const glm::ivec2& pixel,
                         const Workers& workers);

}  // namespace halfspace
