// SPDX-License-Identifier: Apache-2.0
//
// Converts window events to actions, camera movements and dropped files.
#pragma once

#include <SDL.h>

#include <functional>
#include <glm/glm.hpp>
#include <set>
#include <string>

#include "view/viewer.h"

namespace halfspace {

/// Callbacks for events that do not change the Viewer.
struct InputHandlers {
  std::function<void(Action)> on_action;  ///< a key that Viewer::press does not handle
  std::function<void(const std::string&)> on_drop;
  std::function<void()> on_close;
};

class Input {
 public:
  /// Handles one event. keyboard_taken: a text field has the focus. mouse_taken: the mouse is over a panel.
  void handle(const SDL_Event& event, Viewer& viewer, bool keyboard_taken, bool mouse_taken, const InputHandlers& handlers);

  /// Applies the input since the last frame: held keys, for the given time, and mouse movements.
  void apply(Viewer& viewer, double seconds, int window_height);

  /// Returns true while the user moves the camera.
  bool is_moving() const { return !held_.empty() || drag_ != Drag::none || wheel_frames_ > 0; }
  const glm::ivec2& mouse() const { return mouse_; }

 private:
  enum class Drag { none, orbit, pan };

  void press(const SDL_KeyboardEvent& key, Viewer& viewer, const InputHandlers& handlers);
  void handle_mouse(const SDL_Event& event, bool taken);

  std::set<Action> held_, pressed_;  // pressed_: keys pressed since the last frame
  Drag drag_ = Drag::none;
  glm::ivec2 mouse_{0}, orbited_{0}, panned_{0};  // orbited_, panned_: mouse movement since the last frame
  double wheel_ = 0.0;
  int wheel_frames_ = 0;  // remaining frames in which the camera counts as moving after scrolling
};

}  // namespace halfspace
