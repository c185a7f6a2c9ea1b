// SPDX-License-Identifier: Apache-2.0
//
// The state of halfspace-view without a window: the scene, its camera, the time, the overlay, and what keys and the mouse change.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "halfspace/render/opened_scene.h"
#include "view/actions.h"
#include "view/overlay.h"
#include "view/scene_changes.h"

namespace halfspace {

class Viewer {
 public:
  /// seconds: time of the first frame.
  Viewer(OpenedScene opened, double seconds);

  /// Returns the scene at the current time. Throws InputError if an animation leaves the range of its key.
  SceneDescription description() const { return scene_.at(seconds_); }
  const SceneFile& scene() const { return scene_; }
  const OpenedScene& opened() const { return opened_; }
  double seconds() const { return seconds_; }
  /// The same, but 0 if the picture does not change with time.
  double animation_seconds() const { return is_animated() ? seconds_ : 0.0; }
  /// Changes with every change of the scene file.
  int revision() const { return revision_; }

  /// Handles a key press, except for those that the window handles itself: pick, save, and what it shows.
  void press(Action action, bool shift = false);
  /// Moves the camera as a held key does in some seconds.
  void move(Action movement, double seconds);
  void orbit(double yaw_degrees, double pitch_degrees);
  void pan(double right, double down);
  void zoom(double factor);
  /// Sets keys as `--set` does. On errors, the message says what is wrong.
  void set(const std::vector<std::string>& settings);
  /// Lets time pass, unless it is paused.
  void advance(double seconds);

  bool is_paused() const { return paused_; }
  /// Returns true if the picture changes now that time passes.
  bool is_running() const { return !paused_ && is_animated(); }
  Overlay overlay() const { return overlay_; }
  /// Name of the object that `v` hides; empty: all.
  void set_picked_object(const std::string& name) { picked_object_ = name; }

  /// A line about the last action.
  const std::string& message() const { return message_; }
  void set_message(std::string text) { message_ = std::move(text); }

 private:
  bool is_animated() const;
  std::string camera_name() const;
  void change_camera(const std::function<void(CameraDescription&)>& change);
  bool restore_camera();
  void reset_or_next_camera();
  std::string change(const std::function<std::string()>& function);

  OpenedScene opened_;  // as it was opened
  SceneFile scene_;     // with all changes
  double seconds_;
  bool paused_ = false;
  int revision_ = 0;
  Overlay overlay_ = Overlay::none;
  ShadowToggle shadows_;
  VisibilityToggle visibility_;
  std::string base_camera_;  // that a free camera was made from
  std::string picked_object_, message_;
};

}  // namespace halfspace
