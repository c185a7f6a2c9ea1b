// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/scene_preparation.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "halfspace/render/prepare/scene_background.h"
#include "halfspace/render/prepare/scene_meshes.h"
#include "halfspace/render/prepare/scene_places.h"
#include "halfspace/render/shadow/shadow_renderer.h"

namespace halfspace::HS_LANES {

ScenePreparation::ScenePreparation(const SceneDescription& scene, int width, int height, const MinimumSizes& minimum, AssetCache& cache,
                                   DetailCache* details, Warnings& warnings, const Workers& workers)
    : scene_(scene),
      warnings_(warnings),
      workers_(workers),
      view_(make_view(camera_of(scene), width, height)),
      used_(cache),
      clusters_(used_),
      lights_(scene, view_, used_),
      maps_(scene, view_, minimum.map_widths, used_, workers),
      environments_(scene, view_, minimum.environments, maps_, used_, workers),
      surfaces_(scene, view_, lights_, maps_, environments_, warnings),
      details_(maps_, used_, workers),
      materials_(view_, lights_, environments_, used_, warnings, workers),
      shapes_(scene, view_, lights_, SceneMeshes(maps_, used_, workers), AdaptiveMeshes(view_, maps_, used_, workers), surfaces_, details_,
              clusters_, draws_),
      models_(scene, view_, materials_, surfaces_, details_, clusters_, used_, warnings, draws_, details, workers),
      spheres_(scene, view_, lights_, surfaces_, used_, draws_) {}

namespace {

// Returns true if no light reaches any surface.
bool is_dark(const SceneDescription& scene) {
  return scene.lights.empty() && scene.head.ambient.linear == glm::dvec3(0.0) && scene.environments.empty();
}

// Returns true if the surface of the object is black without light. The materials of model files are checked when they are drawn.
bool needs_light(const ObjectDescription& o) {
  return !o.shadow_only && o.shape != Shape::file && o.surface.shading != ShadingRate::none && o.surface.emissive.linear == glm::dvec3(0.0);
}

}  // namespace

PreparedScene ScenePreparation::prepare() {
  add_objects();
  add_particles();
  PreparedScene out;
  out.clear_color = background_color(scene_.background);
  std::ranges::move(draws_.normals, std::back_inserter(draws_.opaque));
  if (auto background = background_draw(scene_.background, view_, environments_)) draws_.opaque.push_back(std::move(*background));
  if (scene_.background.type == BackgroundType::transparent) {
    out.transparent = true;
    out.clear_color = glm::vec4(0.0f);
  }
  out.draws = std::move(draws_.opaque);
  for (PreparedDraw& draw : draws_.blended) out.draws.push_back(std::move(draw));
  out.meshes = std::move(draws_.meshes);
  out.spheres = std::move(draws_.spheres);
  out.simplified = std::move(draws_.simplified);
  out.post = scene_.post;
  out.samples = scene_.head.samples;
  out.view = view_;
  out.lights = lights_.prepared();
  add_shadows(out);
  out.images_ms = materials_.images_ms();
  out.assets = used_.take();
  return out;
}

void ScenePreparation::add_objects() {
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    const auto& [name, object] = scene_.objects[i];
    if (!object.visible) continue;
    const int index = static_cast<int>(i);
    const std::string path = "objects." + name;
    draws_.needs_light = draws_.needs_light || needs_light(object);
    switch (object.shape) {
      case Shape::sphere: spheres_.add(index, path, object); break;
      case Shape::file: models_.add(index, path, object); break;
      default: shapes_.add(index, path, object); break;
    }
  }
  if (draws_.needs_light && is_dark(scene_))
    warnings_.warn_once("nothing lights the scene; expected a light, ambient light or an environment");
}

void ScenePreparation::add_particles() {
  auto index = static_cast<int>(scene_.objects.size());
  spheres_.add_particles(index, "particles", scene_.particles);
  for (const auto& [name, p] : scene_.particle_systems) spheres_.add_particles(++index, "particle_systems." + name, p);
}

void ScenePreparation::add_shadows(PreparedScene& out) {
  if (scene_.shadow.method == ShadowMethod::none) return;
  ShadowRenderer renderer(scene_.shadow, view_, out.meshes, out.spheres, used_, workers_);
  for (std::size_t i = 0; i < out.lights.size(); ++i) {
    PreparedLight& light = out.lights[i];
    if (!light.description.shadow) continue;
    const auto start = std::chrono::steady_clock::now();
    const RenderedShadow rendered = renderer.render(light.name, light.description);
    lights_.shadows()[i] = rendered.shadow;
    used_.keep(rendered.views);
    out.shadow_statistics += rendered.statistics;
    light.map_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
}

}  // namespace halfspace::HS_LANES
