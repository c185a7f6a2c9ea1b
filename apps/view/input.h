// SPDX-License-Identifier: Apache-2.0
//
// Turns the events of the window into actions, movements of the camera and dropped files.
#pragma once

#include <SDL.h>

#include <functional>
#include <glm/glm.hpp>
#include <set>
#include <string>

#include "view/viewer.h"

namespace halfspace {

/// What an event can ask for, besides changes of the Viewer.
struct InputHandlers {
  std::function<void(Action)> on_action;  ///< a key that Viewer::press does not handle
  std::function<void(const std::string&)> on_drop;
  std::function<void()> on_close;
};

class Input {
 public:
  /// Handles one event. keyboard_taken and mouse_taken: the user interface uses the keyboard (a text field has the focus) or the mouse.
  void handle(const SDL_Event& event, Viewer& viewer, bool keyboard_taken, bool mouse_taken, const InputHandlers& handlers);

  /// Applies what happened since the last frame: held keys for some seconds, and the movements of the mouse.
  void apply(Viewer& viewer, double seconds, int window_height);

  /// Whether the camera is being moved.
  bool is_moving() const { return !held_.empty() || drag_ != Drag::none || wheel_frames_ > 0; }
  const glm::ivec2& mouse() const { return mouse_; }

 private:
  enum class Drag { none, orbit, pan };

  void press(const SDL_KeyboardEvent& key, Viewer& viewer, const InputHandlers& handlers);
  void handle_mouse(const SDL_Event& event, bool taken);

  std::set<Action> held_, pressed_;  // pressed_: since the last frame
  Drag drag_ = Drag::none;
  glm::ivec2 mouse_{0}, orbited_{0}, panned_{0};  // the last two: movement of the mouse since the last frame
  double wheel_ = 0.0;
  int wheel_frames_ = 0;  // frames for which the camera counts as moving after the wheel has turned
};

}  // namespace halfspace
