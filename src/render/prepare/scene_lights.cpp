// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/scene_lights.h"

#include <algorithm>
#include <memory>

#include "halfspace/core/trig_double.h"
#include "halfspace/render/prepare/light_cells.h"
#include "halfspace/scene/lights.h"

namespace halfspace::HS_LANES {

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

SceneLights::SceneLights(const SceneDescription& scene, const View& view, UsedAssets& used)
    : prepared_(shining_lights(scene, view.eye_ws)), ambient_(ambient_of(scene)) {
  const auto shadows = std::make_shared<std::vector<Shadow>>(prepared_.size());
  const auto lights = std::make_shared<std::vector<Light>>(), shadowless = std::make_shared<std::vector<Light>>();
  for (std::size_t i = 0; i < prepared_.size(); ++i) {
    PreparedLight& light = prepared_[i];
    shadowless->push_back(light.light);
    if (scene.shadow.method != ShadowMethod::none && light.description.shadow) light.light.shadow = &(*shadows)[i];
    lights->push_back(light.light);
  }
  const std::shared_ptr<const LightCells> cells = light_cells(view, *lights);
  shadows_ = *shadows;
  lights_ = {*lights, cells.get()};
  shadowless_lights_ = {*shadowless, cells.get()};
  used.keep(shadows);
  used.keep(lights);
  used.keep(shadowless);
  used.keep(cells);
}

bool SceneLights::have_shadow(bool receives_shadow) const {
  return std::ranges::any_of(of_surface(receives_shadow), [](const Light& l) { return l.shadow != nullptr; });
}

}  // namespace halfspace::HS_LANES
