// SPDX-License-Identifier: Apache-2.0
#include "view/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "halfspace/core/check.h"
#include "halfspace/scene/scene_paths.h"
#include "view/camera_control.h"
#include "view/enclosing_object.h"

namespace halfspace {

namespace {

constexpr double kQuarterStop = 1.189207115002721;  // 2^(1/4)

bool same_keys(CameraDescription a, CameraDescription b) { return json_of(section_of(a)) == json_of(section_of(b)); }

}  // namespace

Viewer::Viewer(OpenedScene opened, double seconds) : opened_(std::move(opened)), scene_(opened_.scene), seconds_(seconds) {}

std::string Viewer::camera_name() const {
  const SceneDescription& d = scene_.description();
  if (!d.head.camera.empty() || d.cameras.empty()) return d.head.camera;
  return d.cameras.front().first;
}

// Calls a function that changes the scene and returns a message. On errors, returns the error message instead.
std::string Viewer::change(const std::function<std::string()>& function) {
  ++revision_;
  try {
    return function();
  } catch (const InputError& e) {
    return e.what();
  }
}

void Viewer::change_camera(const std::function<void(CameraDescription&)>& function) {
  const std::string problem = change([&] {
    const SceneDescription now = description();
    std::string name = camera_name();
    const CameraDescription* found = find_named(now.cameras, name);
    if (found == nullptr) return std::string("this scene has no camera to move");
    CameraDescription camera = *found;
    if (is_animated_camera(scene_, name)) {
      base_camera_ = name;
      name = add_camera(scene_, camera);
    }
    function(camera);
    if (opened_.model != nullptr) widen_depth_range(camera);
    set_camera_keys(scene_, name, camera);
    return std::string();
  });
  if (!problem.empty()) message_ = problem;
}

void Viewer::move(Action movement, double seconds) {
  constexpr double kNearest = 0.1;  // in radii of the model
  change_camera([&](CameraDescription& c) { apply_movement(c, movement, seconds, kNearest * opened_.model_radius); });
}
void Viewer::orbit(double yaw, double pitch) {
  change_camera([&](CameraDescription& c) { orbit_camera(c, yaw, pitch); });
}
void Viewer::pan(double right, double down) {
  change_camera([&](CameraDescription& c) { pan_camera(c, right, down); });
}
void Viewer::zoom(double factor) {
  change_camera([&](CameraDescription& c) { zoom_camera(c, factor); });
}

// Restores the selected camera. Returns false if it has not moved.
bool Viewer::restore_camera() {
  const std::string name = camera_name();
  const CameraDescription* current = find_named(scene_.description().cameras, name);
  const CameraDescription* original = find_named(opened_.scene.description().cameras, name);
  if (current == nullptr) return false;
  if (original == nullptr) {
    const Json patch = {{"camera", base_camera_}, {"cameras", {{name, nullptr}}}};
    scene_.merge(patch.dump(), "view");
    return true;
  }
  if (same_keys(*current, *original)) return false;
  set_camera_keys(scene_, name, *original);
  return true;
}

// Names the camera, and the object that it is inside of, because the inner side of most objects is not drawn.
std::string Viewer::camera_text() const {
  const SceneDescription now = description();
  const std::string name = camera_name();
  const CameraDescription* camera = find_named(now.cameras, name);
  const std::string object = camera == nullptr ? "" : enclosing_object(now, camera->position);
  if (object.empty()) return "camera " + name;
  const bool drawn = find_named(now.objects, object)->surface.two_sided;
  return fmt::format("camera {}: inside of '{}', whose inner side is {}drawn; press x for the next camera", name, object,
                     drawn ? "" : "not ");
}

void Viewer::reset_or_next_camera() {
  message_ = change([&] {
    if (restore_camera()) return camera_text();
    const Named<CameraDescription>& cameras = scene_.description().cameras;
    if (cameras.empty()) return std::string("this scene has no cameras");
    const auto current = std::ranges::find(cameras, camera_name(), [](const auto& entry) { return entry.first; });
    const auto next = current == cameras.end() || current + 1 == cameras.end() ? cameras.begin() : current + 1;
    scene_.set("camera=" + std::string(next->first));
    return camera_text();
  });
}

void Viewer::set(const std::vector<std::string>& settings) {
  message_ = change([&] {
    scene_.set(settings);
    return settings.front();
  });
}

void Viewer::press(Action action, bool shift) {
  const auto shade = [&](const char* rate) { message_ = change([&] { return set_shading_rate(scene_, rate); }); };
  switch (action) {
    case Action::reset_camera: return reset_or_next_camera();
    case Action::shade_none: return shade("none");
    case Action::shade_flat: return shade("flat");
    case Action::shade_gouraud: return shade("gouraud");
    case Action::shade_phong: return shade("phong");
    case Action::cycle_normals: message_ = change([&] { return cycle_relief(scene_, model()); }); return;
    case Action::toggle_textures: message_ = change([&] { return toggle_color_maps(scene_, model()); }); return;
    case Action::toggle_shadows: message_ = change([&] { return shadows_.toggle(scene_); }); return;
    case Action::toggle_visibility: message_ = change([&] { return visibility_.toggle(scene_, picked_object_); }); return;
    case Action::darker: message_ = change([&] { return change_exposure(scene_, 1.0 / kQuarterStop); }); return;
    case Action::brighter: message_ = change([&] { return change_exposure(scene_, kQuarterStop); }); return;
    case Action::pause:
      paused_ = !paused_;
      message_ = !is_animated() ? "this scene has no animation"
                 : paused_      ? fmt::format("paused at {:.2f} s", seconds_)
                                : "animation resumed";
      return;
    case Action::next_overlay:
      overlay_ = halfspace::next_overlay(overlay_, shift);
      message_ = fmt::format("overlay: {}", name_of(overlay_));
      return;
    default: return;
  }
}

void Viewer::advance(double seconds) {
  if (!paused_) seconds_ += seconds;
}

bool Viewer::is_animated() const { return !scene_.description().animations.empty() && scene_.description().animation.speed != 0.0; }

}  // namespace halfspace
