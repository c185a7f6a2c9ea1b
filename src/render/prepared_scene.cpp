// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepared_scene.h"

#include <algorithm>

#include "halfspace/core/float_mode.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/render/preparation.h"
#include "halfspace/scene/lights.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

Light make_light(const LightDescription& d, const glm::dvec3& eye_ws) {
  constexpr double kMinCone = 1e-6;    // difference of cosines; small enough for a hard edge
  constexpr double kMinRange = 1e-30;  // its reciprocal is a finite float
  const glm::dvec3 towards = unit_or_zero(d.direction), color = d.color.linear * d.intensity;
  const double cos_inner = sincos_turns(d.inner / 360.0).cos, cos_outer = sincos_turns(d.outer / 360.0).cos;
  Light light;
  light.type = d.type;
  light.position_rws = glm::vec3(kind_of(d.type).is_distant ? towards : d.position - eye_ws);
  light.diffuse = glm::vec3(color * d.diffuse);
  light.specular = glm::vec3(color * d.specular);
  light.attenuation = d.falloff == Falloff::physical ? glm::vec3(0, 0, 1) : glm::vec3(d.attenuation);
  light.axis_ws = glm::vec3(towards);
  light.cos_outer = static_cast<float>(cos_outer);
  light.cone_scale = static_cast<float>(1.0 / std::max(cos_inner - cos_outer, kMinCone));
  light.inverse_range = d.range > 0.0 ? static_cast<float>(1.0 / std::max(d.range, kMinRange)) : 0.0f;
  return light;
}

// Returns the lights that emit diffuse or specular light.
std::vector<PreparedLight> shining_lights(const SceneDescription& scene, const glm::dvec3& eye_ws) {
  std::vector<PreparedLight> lights;
  for (const auto& [name, d] : scene.lights) {
    const Light light = make_light(d, eye_ws);
    if (light.diffuse != glm::vec3(0.0f) || light.specular != glm::vec3(0.0f)) lights.push_back({name, light, d});
  }
  return lights;
}

// Ambient light reaches every point regardless of the light that it belongs to, so it is summed here.
glm::dvec3 ambient_of(const SceneDescription& scene) {
  glm::dvec3 sum = scene.head.ambient.linear;
  for (const auto& [name, light] : scene.lights) sum += light.color.linear * light.intensity * light.ambient;
  return sum;
}

}  // namespace

const CameraDescription& camera_of(const SceneDescription& scene) {
  for (const auto& [name, camera] : scene.cameras) {
    if (name == scene.head.camera) return camera;
  }
  return scene.cameras.front().second;
}

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
      ambient_(ambient_of(scene)),
      used_(cache),
      maps_(scene, view_, minimum.map_widths, used_, workers),
      environments_(scene, view_, minimum.environments, maps_, used_, workers) {
  out_.view = view_;
  out_.lights = shining_lights(scene, view_.eye_ws);
  const auto shadows = std::make_shared<std::vector<Shadow>>(out_.lights.size());
  const auto lights = std::make_shared<std::vector<Light>>(), shadowless = std::make_shared<std::vector<Light>>();
  for (std::size_t i = 0; i < out_.lights.size(); ++i) {
    PreparedLight& light = out_.lights[i];
    shadowless->push_back(light.light);
    if (scene.shadow.method != ShadowMethod::none && light.description.shadow) light.light.shadow = &(*shadows)[i];
    lights->push_back(light.light);
  }
  shadows_ = *shadows;
  lights_ = *lights;
  shadowless_lights_ = *shadowless;
  used_.keep(shadows);
  used_.keep(lights);
  used_.keep(shadowless);
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
  add_background();
  add_blended();
  add_shadows();
  out_.assets = used_.take();
  return std::move(out_);
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

PreparedScene SceneAssets::prepare(const SceneDescription& scene, int width, int height) {
  const FloatMode float_mode;
  PreparedScene prepared = ScenePreparation(scene, width, height, minimum_, cache_, warnings_, workers_).prepare();
  cache_.remove_unwanted();
  return prepared;
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
