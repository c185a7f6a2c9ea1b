// SPDX-License-Identifier: Apache-2.0
//
// The state of halfspace-view without its window: the scene, the camera, the time and the overlay, and how keys and the mouse change them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "halfspace/render/model_file/opened_scene.h"
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
  /// Returns seconds(), or 0 if the picture does not change with time.
  double animation_seconds() const { return is_animated() ? seconds_ : 0.0; }
  /// Returns a number that changes with every change of the scene file.
  int revision() const { return revision_; }

  /// Handles a key press. The window handles the actions pick and save and those that show or hide panels.
  void press(Action action, bool shift = false);
  /// Moves the camera like a key that is held for `seconds`.
  void move(Action movement, double seconds);
  void orbit(double yaw_degrees, double pitch_degrees);
  void pan(double right, double down);
  void zoom(double factor);
  /// Sets keys like `--set`. On errors, sets the message.
  void set(const std::vector<std::string>& settings);
  /// Advances the time unless it is paused.
  void advance(double seconds);

  bool is_paused() const { return paused_; }
  /// Returns true if the picture changes with time and the time is not paused.
  bool is_running() const { return !paused_ && is_animated(); }
  Overlay overlay() const { return overlay_; }
  /// Sets the name of the object that the key `v` hides; empty for all objects.
  void set_picked_object(const std::string& name) { picked_object_ = name; }
  /// Ends the selection of an object. The key `v` then hides or shows all objects.
  void clear_picked_object() {
    picked_object_.clear();
    visibility_.forget_object();
  }

  /// Returns a line about the last action.
  const std::string& message() const { return message_; }
  void set_message(std::string text) { message_ = std::move(text); }

 private:
  bool is_animated() const;
  std::string camera_name() const;
  void change_camera(const std::function<void(CameraDescription&)>& change);
  bool restore_camera();
  void reset_or_next_camera();
  std::string camera_text() const;
  std::string change(const std::function<std::string()>& function);
  const Model* model() const { return opened_.model == nullptr ? nullptr : &opened_.model->model; }

  OpenedScene opened_;  // original scene
  SceneFile scene_;     // scene with all changes
  double seconds_;
  bool paused_ = false;
  int revision_ = 0;
  Overlay overlay_ = Overlay::none;
  ShadowToggle shadows_;
  VisibilityToggle visibility_;
  std::string base_camera_;  // camera that the free camera was created from
  std::string picked_object_, message_;
};

}  // namespace halfspace
