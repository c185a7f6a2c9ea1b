// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepared_scene.h"

#include <chrono>

#include "halfspace/core/float_mode.h"
#include "halfspace/render/model/model_chooser.h"
#include "halfspace/render/preparation.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

DrawState opaque_state(CullMode cull, bool mirrored) {
  DrawState state;
  state.cull = cull;
  if (mirrored) state.front = Winding::clockwise;
  state.depth.clip = ClipDepth::zero_to_one;
  state.depth.compare = CompareOp::greater;
  return state;
}

DrawState sprite_state() {
  DrawState state = opaque_state(CullMode::none, false);
  state.topology = Topology::points;
  return state;
}

ScenePreparation::ScenePreparation(const SceneDescription& scene, int width, int height, const MinimumSizes& minimum, AssetCache& cache,
                                   Warnings& warnings, const Workers& workers)
    : scene_(scene),
      warnings_(warnings),
      workers_(workers),
      view_(make_view(camera_of(scene), width, height)),
      used_(cache),
      lights_(scene, view_.eye_ws, used_),
      maps_(scene, view_, minimum.map_widths, used_, workers),
      environments_(scene, view_, minimum.environments, maps_, used_, workers),
      surfaces_(view_, lights_, maps_, environments_),
      meshes_(maps_, used_, workers),
      details_(maps_, used_, workers),
      materials_(view_, lights_, environments_, used_, warnings, workers) {
  out_.view = view_;
  out_.lights = lights_.prepared();
}

namespace {

// Returns true if no light reaches any surface.
bool is_dark(const SceneDescription& scene) {
  return scene.lights.empty() && scene.head.ambient.linear == glm::dvec3(0.0) && scene.environments.empty();
}

// Returns true if the surface of the object is black without light. The materials of model files are checked when they are drawn.
bool needs_light(const ObjectDescription& o) {
  return o.visible && !o.shadow_only && o.shape != Shape::file && o.surface.shading != ShadingRate::none &&
         o.surface.emissive.linear == glm::dvec3(0.0);
}

}  // namespace

PreparedScene ScenePreparation::prepare() {
  out_.clear_color = glm::vec4(glm::vec3(scene_.background.color.linear), 1.0f);
  out_.post = scene_.post;
  out_.samples = scene_.head.samples;
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    const ObjectDescription& object = scene_.objects[i].second;
    needs_light_ = needs_light_ || needs_light(object);
    if (object.visible) add_object(static_cast<int>(i));
  }
  if (needs_light_ && is_dark(scene_)) warnings_.warn_once("nothing lights the scene; expected a light, ambient light or an environment");
  auto particles = static_cast<int>(scene_.objects.size());
  add_particles(particles, scene_.particles, "particles");
  for (const auto& [name, p] : scene_.particle_systems) add_particles(++particles, p, "particle_systems." + name);
  if (auto background = background_draw(scene_.background, view_, environments_)) out_.draws.push_back(std::move(*background));
  if (scene_.background.type == BackgroundType::transparent) {
    out_.transparent = true;
    out_.clear_color = glm::vec4(0.0f);
  }
  add_blended();
  add_shadows();
  out_.images_ms = materials_.images_ms();
  out_.assets = used_.take();
  return std::move(out_);
}

void ScenePreparation::add_shadows() {
  if (scene_.shadow.method == ShadowMethod::none) return;
  const ShadowRenderer renderer(scene_.shadow, view_, out_.meshes, out_.spheres, workers_);
  for (std::size_t i = 0; i < out_.lights.size(); ++i) {
    PreparedLight& light = out_.lights[i];
    if (!light.description.shadow) continue;
    const auto start = std::chrono::steady_clock::now();
    const RenderedShadow rendered = renderer.render(light.name, light.description);
    lights_.shadows()[i] = rendered.shadow;
    used_.keep(rendered.maps);
    out_.shadow_statistics += rendered.statistics;
    light.map_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
}

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

FittedScene SceneAssets::fit(const SceneDescription& scene, int width, int height, const AllowedError& allowed) {
  const FloatMode float_mode;
  const View view = make_view(camera_of(scene), width, height);
  UsedAssets used(cache_);
  SceneMaps maps(scene, view, minimum_.map_widths, used, workers_);
  return ModelChooser(scene, view, maps, used, workers_).fit(allowed);
}

PreparedScene SceneAssets::prepare(const SceneDescription& scene, int width, int height) {
  const FloatMode float_mode;
  PreparedScene prepared = ScenePreparation(scene, width, height, minimum_, cache_, warnings_, workers_).prepare();
  cache_.remove_unwanted();
  return prepared;
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
