// SPDX-License-Identifier: Apache-2.0
//
// Changes to a scene by keyboard shortcuts. All changes set keys of the scene file, so a saved scene contains them. Each function returns a
// line that says what was changed, or why nothing was changed.
#pragma once

#include <string>
#include <vector>

#include "halfspace/model/model.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

/// Sets a key if the scene accepts the value. Returns an empty string on success, otherwise the reason.
std::string try_set(SceneFile& scene, const std::string& setting);

/// Sets the shading rate of all objects that accept it. Materials of model files only accept `none` and `phong`.
std::string set_shading_rate(SceneFile& scene, const std::string& rate);

/// Switches the relief of all objects to the next of: none, normal map, bump map. For displaced objects: no displacement, normals per
/// pixel, normals per vertex. For models: off, or the maps of their materials. model: the model that the scene was generated for, or null.
std::string cycle_relief(SceneFile& scene, const Model* model);

/// Switches the color maps of all objects and the materials of models on or off. model: as in cycle_relief.
std::string toggle_color_maps(SceneFile& scene, const Model* model);

/// Hides and shows objects and particles.
class VisibilityToggle {
 public:
  /// Toggles the object with this name, or all objects and particles if the name is empty. If the previous call hid a single object, shows
  /// it again instead, because `object` is now what was behind it.
  std::string toggle(SceneFile& scene, const std::string& object);
  /// Forgets which object was hidden.
  void forget_object() { hidden_object_.clear(); }

 private:
  std::string hidden_object_;                  // the single object that the previous call hid, or empty
  std::vector<std::string> hidden_particles_;  // settings that show the particles again
};

/// Switches shadows off, or on with the method that was set before.
class ShadowToggle {
 public:
  std::string toggle(SceneFile& scene);

 private:
  std::string method_ = "pcf3";
};

/// Multiplies the exposure by `factor`. If the scene does not use post.hdr, turns it on without a tone curve.
std::string change_exposure(SceneFile& scene, double factor);

/// Sets all keys of a camera of the scene.
void set_camera_keys(SceneFile& scene, const std::string& name, CameraDescription camera);

/// Returns true if an animation changes a key of this camera.
bool is_animated_camera(const SceneFile& scene, const std::string& name);

/// Adds a camera to the scene and selects it. Returns its name.
std::string add_camera(SceneFile& scene, CameraDescription camera);

}  // namespace halfspace
