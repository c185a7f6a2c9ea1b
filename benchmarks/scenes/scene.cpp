// SPDX-License-Identifier: Apache-2.0
#include "scenes/scene.h"

#include <algorithm>

#include "halfspace/geometry/camera.h"
#include "scenes/scene_kinds.h"
#include "workloads/workload_assets.h"
#include "workloads/workload_canvas.h"

namespace halfspace {

namespace {

constexpr double kNear = 0.1, kFar = 500.0;

glm::dmat4 light_matrix(const SceneLighting& light) {
  const double r = light.shadow_radius;
  const glm::dmat4 view = look_at(light.shadow_center + glm::dvec3(light.to_sun), light.shadow_center, {0, 1, 0});
  return orthographic_gl(2 * r, 1.0, 1 - r, 1 + r) * view;
}

// Returns the squared distance of an object from the eye.
double distance2(const Scene& scene, std::size_t object, const glm::dvec3& eye) {
  const SceneObject& o = scene.objects[object];
  const glm::dvec3 d = glm::dvec3(o.world_from_object * glm::dvec4(scene.mesh(o).center, 1.0)) - eye;
  return glm::dot(d, d);
}

std::vector<std::size_t> drawing_order(const Scene& scene, const glm::dvec3& eye) {
  std::vector<std::size_t> order(scene.objects.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto surface = [&](std::size_t i) { return scene.material(scene.objects[i]).surface; };
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    if (surface(a) != surface(b)) return surface(a) < surface(b);
    if (surface(a) == SceneSurface::blended) return distance2(scene, a, eye) > distance2(scene, b, eye);
    return scene.objects[a].material < scene.objects[b].material;
  });
  return order;
}

}  // namespace

std::size_t Scene::triangles() const {
  std::size_t sum = 0;
  for (const SceneObject& object : objects) sum += mesh(object).count / 3;
  return sum;
}

Scene make_scene(SceneKind kind) {
  switch (kind) {
    case SceneKind::hall: return make_hall();
    case SceneKind::garden: return make_garden();
    case SceneKind::workshop: return make_workshop();
  }
  return {};
}

std::shared_ptr<const Scene> shared_scene(WorkloadAssets& assets, SceneKind kind) {
  return assets.once<Scene>("scene " + std::to_string(static_cast<int>(kind)), [kind] { return make_scene(kind); });
}

SceneView scene_view(const Scene& scene, const SceneCamera& camera, WorkloadSize size) {
  SceneView view{.clip_from_world = glm::mat4(workload_projection(size, kNear, kFar) * look_at(camera.eye, camera.target, {0, 1, 0})),
                 .light_from_world = glm::mat4(light_matrix(scene.light)),
                 .eye_ws = glm::vec3(camera.eye),
                 .order = drawing_order(scene, camera.eye),
                 .casters = {}};
  std::ranges::copy_if(view.order, std::back_inserter(view.casters),
                       [&](std::size_t i) { return scene.material(scene.objects[i]).surface <= SceneSurface::cutout; });
  return view;
}

DrawState scene_shadow_state() { return {}; }

DrawState scene_state(const SceneMaterial& material) {
  DrawState state = material.surface == SceneSurface::blended ? kAlphaBlendState : kOpaqueState;
  if (!material.two_sided) state.cull = CullMode::back;
  return state;
}

std::span<const SceneRow> scene_rows() {
  static const std::vector<SceneRow> rows = [] {
    struct Kind {
      SceneKind kind;
      std::string name;
      std::array<const char*, kSceneCameras> views;
    };
    const std::array kinds{
        Kind{SceneKind::hall, "hall", {"along the nave", "an aisle, near a column", "from outside", "from the dais", "the vault"}},
        Kind{SceneKind::garden,
             "garden",
             {"along the path", "inside the greenhouse", "from above", "at the pond, near reeds", "inside the pavilion"}},
        Kind{SceneKind::workshop, "workshop", {"from the door", "tools on a bench, near", "from outside", "a rack, near", "from above"}},
    };
    std::vector<SceneRow> all;
    for (const Kind& k : kinds) {
      for (int i = 0; i < kSceneCameras; ++i)
        all.push_back({"scene_" + k.name + "_" + std::to_string(i + 1), k.name + ": " + k.views[static_cast<std::size_t>(i)], k.kind, i});
    }
    return all;
  }();
  return rows;
}

}  // namespace halfspace
