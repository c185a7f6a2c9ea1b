// SPDX-License-Identifier: Apache-2.0
//
// A panel with all keys of a scene, generated from the same key table as the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "halfspace/scene/scene_paths.h"
#include "view/viewer.h"

namespace halfspace {

class ScenePanel {
 public:
  /// Draws the panel at the right side of the display, and sets the keys that the user changes.
  void draw(Viewer& viewer, double ui_scale);
  /// Returns the width of the panel in pixels.
  static float width(double ui_scale);

 private:
  void read_scene(const Viewer& viewer);

  std::optional<int> revision_;  // revision of scene_
  SceneDescription scene_;
  std::vector<NamedSection> sections_;  // refer to scene_
};

/// Draws a widget for a key. If the user changed the value, returns the new value in the form that --set accepts.
std::optional<std::string> draw_key(const Field& field);

}  // namespace halfspace
