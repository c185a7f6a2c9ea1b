// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/scene_assets.h"

#include <array>
#include <optional>
#include <typeindex>
#include <utility>

#include "halfspace/core/float_mode.h"
#include "halfspace/core/resource_limits.h"
#include "halfspace/render/error_budget/approximation_chooser.h"
#include "halfspace/render/prepare/model_preparation.h"
#include "halfspace/render/prepare/scene_environments.h"
#include "halfspace/render/prepare/scene_maps.h"
#include "halfspace/render/prepare/scene_places.h"
#include "halfspace/render/prepare/scene_preparation.h"
#include "halfspace/render/shadow/kept_shadow_maps.h"

namespace halfspace::HS_LANES {

void SceneAssets::expect(const SceneDescription& scene, int width, int height) {
  const View view = make_view(camera_of(scene), width, height);
  UsedAssets used(cache_);
  SceneMaps maps(scene, view, minimum_.map_widths, used, workers_);
  for (const auto& [name, object] : scene.objects) {
    if (object.visible) minimum_.map_widths[name] = maps.width_for(object);
  }
  minimum_.environments = SceneEnvironments(scene, view, minimum_.environments, maps, used, workers_).sizes();
}

void SceneAssets::add_model(const std::filesystem::path& file, std::shared_ptr<const ModelAsset> model) {
  warn_of(file, model->model, warnings_);
  const std::string key = model_recipe(file, model->allow_outside);
  cache_.add(key, std::move(model));
}

SceneWithinError SceneAssets::choose_within_error(const SceneDescription& scene, int width, int height, const AllowedError& allowed) {
  const FloatMode float_mode;
  const View view = make_view(camera_of(scene), width, height);
  UsedAssets used(cache_);
  SceneMaps maps(scene, view, minimum_.map_widths, used, workers_);
  return ApproximationChooser(scene, view, maps, used, workers_).choose_within_error(allowed);
}

PreparedScene SceneAssets::prepare(const SceneDescription& scene, int width, int height) {
  const FloatMode float_mode;
  const auto prepare_once = [&] {
    return ScenePreparation(scene, width, height, minimum_, cache_, details_.get(), warnings_, workers_).prepare();
  };
  std::optional<PreparedScene> prepared;
  try {
    prepared = prepare_once();
  } catch (const LimitError&) {
    if (cache_.remove_all<KeptShadowMaps>() == 0) throw;  // otherwise, the memory of the last frame's maps may suffice
  }
  if (!prepared) prepared = prepare_once();
  cache_.remove_unwanted();
  return std::move(*prepared);
}

PreparedScene SceneAssets::prepare_values(SceneDescription scene, int width, int height) {
  const FloatMode float_mode;
  for (auto& [name, light] : scene.lights) light.shadow = false;
  scene.head.ambient = Color{glm::dvec3(1.0)};  // no warning that nothing lights the scene
  scene.reflections.on = false;
  scene.background.type = BackgroundType::color;
  PreparedScene prepared = ScenePreparation(scene, width, height, minimum_, cache_, details_.get(), warnings_, workers_).prepare();
  cache_.remove_unwanted(std::array<std::type_index, 2>{typeid(EnvironmentMap), typeid(FilteredEnvironment)});
  return prepared;
}

void SceneAssets::forget_shadow_maps() { cache_.remove_all<KeptShadowMaps>(); }

}  // namespace halfspace::HS_LANES
