// SPDX-License-Identifier: Apache-2.0
//
// Changes of a scene that a key makes. All of them set keys of the scene file, so that a saved scene has them. Each function returns a line
// that says what was changed, or why nothing was.
#pragma once

#include <string>
#include <vector>

#include "halfspace/scene/scene_file.h"

namespace halfspace {

/// Sets a key if the scene accepts the value. Returns an empty string, or the reason why it does not.
std::string try_set(SceneFile& scene, const std::string& setting);

/// Sets the shading rate of all objects that accept it.
std::string set_shading_rate(SceneFile& scene, const std::string& rate);

/// Switches the relief of all objects: none, normal map, bump map. Displaced objects have normals that are undisplaced, per pixel, per
/// vertex instead.
std::string cycle_relief(SceneFile& scene);

/// Switches the color maps of all objects on or off.
std::string toggle_color_maps(SceneFile& scene);

/// Hides or shows things.
class VisibilityToggle {
 public:
  /// Toggles the object with this name, or all objects and particles if it is empty.
  std::string toggle(SceneFile& scene, const std::string& object);

 private:
  std::vector<std::string> hidden_particles_;  // settings that show them again
};

/// Switches shadows off, or on with the method that they had before.
class ShadowToggle {
 public:
  std::string toggle(SceneFile& scene);

 private:
  std::string method_ = "pcf3";
};

/// Multiplies the exposure. A scene that is shown without exposure is changed to one with exposure and without a tone curve.
std::string change_exposure(SceneFile& scene, double factor);

/// Sets all keys of a camera of the scene.
void set_camera_keys(SceneFile& scene, const std::string& name, CameraDescription camera);

/// Returns whether an animation changes a key of this camera.
bool is_animated_camera(const SceneFile& scene, const std::string& name);

/// Adds a camera to the scene and selects it. Returns its name.
std::string add_camera(SceneFile& scene, CameraDescription camera);

}  // namespace halfspace
