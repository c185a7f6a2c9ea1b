// SPDX-License-Identifier: Apache-2.0
#include "cli/empty_picture.h"

#include <algorithm>

namespace halfspace {

namespace {

bool shows_background(const SceneDescription& scene) {
  return scene.background.type == BackgroundType::environment || scene.background.type == BackgroundType::stars;
}

// Returns what to change in a scene that draws nothing from any camera, or an empty string if it draws something.
std::string advice_for_scene(const SceneDescription& scene) {
  const auto has_spheres = [](const ParticlesDescription& p) { return p.count > 0 || !p.file.path.empty(); };
  const auto is_shown = [](const auto& entry) { return entry.second.visible && !entry.second.shadow_only; };
  const auto is_hidden = [](const auto& entry) { return !entry.second.visible && !entry.second.shadow_only; };
  if (has_spheres(scene.particles) || std::ranges::any_of(scene.objects, is_shown) ||
      std::ranges::any_of(scene.particle_systems, [&](const auto& entry) { return has_spheres(entry.second); }))
    return {};
  const auto hidden = std::ranges::find_if(scene.objects, is_hidden);
  if (hidden == scene.objects.end()) return "a scene with objects or particles";
  return "--set objects." + hidden->first + ".visible=true, because all objects are hidden";
}

// Returns what to change if a picture is empty.
std::string advice_for_view(const RenderJob& job) {
  const RenderArguments& args = job.options.arguments;
  if (!args.output.crop.empty()) return "the picture without --crop";
  if (!is_model_file(job.name)) return "another camera, or another position or target of the camera";
  if (args.model.inside) return "--eye X,Y,Z and --look-at X,Y,Z, or leave out --inside: surfaces are visible only from their fronts";
  if (!args.model.eye.empty() || !args.camera.empty()) return "another view, or leave out --eye and --camera to show the whole model";
  return "another --yaw, --pitch or --zoom";
}

}  // namespace

std::string advice_for_empty_pictures(const RenderJob& job, const RenderReport& report) {
  const SceneDescription& scene = job.scene.description();
  // A single frame of an animation may be empty on purpose.
  const std::string advice = advice_for_scene(scene);
  // A floor covers pixels even if nothing casts a shadow on it.
  const bool shows_floor_only = !advice.empty() && !shows_background(scene) && !job.options.wireframe;
  if (report.pictures == 0 || (!shows_floor_only && report.empty_pictures != report.pictures)) return {};
  return advice.empty() ? advice_for_view(job) : advice;
}

}  // namespace halfspace
