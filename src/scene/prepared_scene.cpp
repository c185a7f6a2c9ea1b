// SPDX-License-Identifier: Apache-2.0
#include "scene/prepared_scene.h"

#include <algorithm>

#include "core/trig_double.h"
#include "scene/camera.h"
#include "scene/preparation.h"

namespace halfspace {

namespace {

std::vector<Light> make_lights(const Named<LightDescription>& descriptions, const glm::dvec3& eye_ws) {
  constexpr double kLeastCone = 1e-6;  // in cosines: a sharp edge
  std::vector<Light> lights;
  for (const auto& [name, d] : descriptions) {
    const glm::dvec3 towards = unit_or_zero(d.direction), color = d.color.linear * d.intensity;
    const double cos_inner = sincos_turns(d.inner / 360.0).cos, cos_outer = sincos_turns(d.outer / 360.0).cos;
    Light light;
    light.type = d.type;
    light.place_ew = glm::vec3(d.type == LightType::directional ? towards : d.position - eye_ws);
    light.diffuse = glm::vec3(color * d.diffuse);
    light.specular = glm::vec3(color * d.specular);
    light.attenuation = d.falloff == Falloff::physical ? glm::vec3(0, 0, 1) : glm::vec3(d.attenuation);
    light.axis_ws = glm::vec3(towards);
    light.cos_outer = static_cast<float>(cos_outer);
    light.cone_scale = static_cast<float>(1.0 / std::max(cos_inner - cos_outer, kLeastCone));
    lights.push_back(light);
  }
  return lights;
}

// The lights, each with its shadow where it casts one.
std::vector<Light> with_shadows(std::vector<Light> lights, const SceneDescription& scene, const std::vector<Shadow>& shadows) {
  for (std::size_t i = 0; i < shadows.size(); ++i)
    if (scene.lights[i].second.shadow) lights[i].shadow = &shadows[i];
  return lights;
}

// Ambient light reaches every point alike, whatever light it is told by.
glm::dvec3 ambient_of(const SceneDescription& scene) {
  glm::dvec3 sum = scene.head.ambient.linear;
  for (const auto& [name, light] : scene.lights) sum += light.color.linear * light.intensity * light.ambient;
  return sum;
}

}  // namespace

ScenePreparation::ScenePreparation(SceneAssets& assets, const SceneDescription& scene, int width, int height)
    : assets_(assets),
      scene_(scene),
      view_(make_view(camera(), width, height)),
      shadows_(std::make_shared<std::vector<Shadow>>(scene.shadow.method == ShadowMethod::none ? 0 : scene.lights.size())),
      shadowless_lights_(std::make_shared<const std::vector<Light>>(make_lights(scene.lights, view_.eye_ws))),
      ambient_(ambient_of(scene)) {
  lights_ = std::make_shared<const std::vector<Light>>(with_shadows(*shadowless_lights_, scene, *shadows_));
  out_.view = view_;
  for (std::size_t i = 0; i < lights_->size(); ++i) out_.lights.push_back({scene.lights[i].first, (*lights_)[i]});
  out_.assets.insert(out_.assets.end(), {shadows_, lights_, shadowless_lights_});
}

PreparedScene ScenePreparation::prepare() {
  out_.clear_color = glm::vec4(glm::vec3(scene_.background.color.linear), 1.0f);
  for (const auto& [name, object] : scene_.objects) {
    if (object.visible) add_object("objects." + name, object);
  }
  if (scene_.background.type == BackgroundType::stars) add_stars();
  add_shadows();
  return std::move(out_);
}

const CameraDescription& ScenePreparation::camera() const {
  for (const auto& [name, camera] : scene_.cameras) {
    if (name == scene_.head.camera) return camera;
  }
  return scene_.cameras.front().second;
}

PreparedScene SceneAssets::prepare(const SceneDescription& scene, int width, int height) {
  for (auto& [recipe, entry] : entries_) entry.wanted = false;
  PreparedScene prepared = ScenePreparation(*this, scene, width, height).prepare();
  std::erase_if(entries_, [](const auto& entry) { return !entry.second.wanted; });
  return prepared;
}

namespace {

PassStatistics draw_all(const PreparedScene& scene, Pass& pass, const Workers& workers) {
  for (const PreparedDraw& draw : scene.draws) add_draw(pass, draw);
  return pass.run(workers);
}

constexpr DepthTarget kDepth{.format = DepthFormat::d32f, .clear_value = 0.0f};

}  // namespace

PassStatistics render(const PreparedScene& scene, Image<glm::u8vec4>& picture, const Workers& workers) {
  ColorTarget color = srgb8a8_target(picture);
  color.clear_value = scene.clear_color;
  Pass pass(picture.width(), picture.height(), color, kDepth);
  return draw_all(scene, pass, workers);
}

PassStatistics render(const PreparedScene& scene, Image<glm::vec4>& picture, const Workers& workers) {
  ColorTarget color = rgba32f_target(picture);
  color.clear_value = scene.clear_color;
  Pass pass(picture.width(), picture.height(), color, kDepth);
  return draw_all(scene, pass, workers);
}

}  // namespace halfspace
