// SPDX-License-Identifier: Apache-2.0
#include "command_line/scene_arguments.h"

#include <algorithm>

#include "command_line/errors.h"
#include "command_line/model_arguments.h"
#include "halfspace/core/check.h"
#include "halfspace/core/text.h"
#include "halfspace/scene/object_keys.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

namespace {

void set_camera(SceneFile& scene, const std::string& name) {
  if (name.empty()) return;
  std::vector<std::string_view> names;
  for (const auto& [camera, description] : scene.description().cameras) names.push_back(camera);
  if (std::ranges::find(names, name) == names.end()) throw InputError("--camera: no camera '" + name + "'" + suggestion(name, names));
  scene.set("camera=" + name);
}

}  // namespace

void set_scene(SceneFile& file, const std::vector<std::string>& settings, const std::string& camera) {
  for (const std::string& setting : settings) {
    if (setting.find('=') == std::string::npos || setting.starts_with('=')) {
      throw UsageError("--set is '" + setting + "'; expected KEY=VALUE, for example camera=main");
    }
  }
  file.set(settings);
  set_camera(file, camera);
}

void set_scene(OpenedScene& opened, const std::vector<std::string>& settings, const std::string& camera) {
  const auto known = opened.camera_names.find(camera);
  set_scene(opened.scene, settings, known == opened.camera_names.end() ? camera : known->second);
}

void set_shading(SceneFile& scene, const std::string& rate) {
  if (rate.empty()) return;
  ObjectDescription any;
  const std::span<const std::string_view> rates = find_field(section_of(any), "shading").key->choices;
  const auto found = std::ranges::find(rates, rate);
  if (found == rates.end()) throw UsageError("--shading is '" + rate + "'" + suggestion(rate, rates));
  const auto value = static_cast<ShadingRate>(found - rates.begin());
  std::vector<std::string> settings;
  for (const auto& [name, object] : scene.description().objects) {
    if (!object.shadow_only && offers_shading(object, value)) settings.push_back("objects." + name + ".shading=" + rate);
  }
  if (settings.empty()) {
    throw UsageError(
        "--shading " + rate +
        " has no effect on this scene: models with their own materials are lit per pixel or not at all; expected phong or none, or "
        "an object of another shape");
  }
  scene.set(settings);
}

}  // namespace halfspace
