// SPDX-License-Identifier: Apache-2.0
//
// A panel with all keys of a scene, made from the key table that the command line uses.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "halfspace/scene/scene_paths.h"
#include "view/viewer.h"

namespace halfspace {

class ScenePanel {
 public:
  /// Draws the panel at the right side of the display. Sets changed keys.
  void draw(Viewer& viewer, double ui_scale);

 private:
  void read_scene(const Viewer& viewer);

  std::optional<int> revision_;  // of the scene that was read
  SceneDescription scene_;
  std::vector<NamedSection> sections_;  // refer to scene_
};

/// Draws a widget for a key. Returns the text for --set if the user changed the value.
std::optional<std::string> draw_key(const Field& field);

}  // namespace halfspace
