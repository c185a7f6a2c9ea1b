// SPDX-License-Identifier: Apache-2.0
#include "scenes/scene.h"

#include <algorithm>
#include <array>

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

// Returns false if all corners of an object's bounding box are outside of the same clip plane.
bool may_be_visible(const Scene& scene, const SceneObject& object, const glm::dmat4& clip_from_world) {
  const SceneMesh& mesh = scene.mesh(object);
  const glm::dmat4 clip_from_object = clip_from_world * object.world_from_object;
  glm::bvec3 all_below(true), all_above(true);
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::bvec3 is_high(corner & 1u, corner & 2u, corner & 4u);
    const glm::dvec4 p = clip_from_object * glm::dvec4(glm::mix(mesh.low, mesh.high, is_high), 1.0);
    for (int axis = 0; axis < 3; ++axis) {
      all_below[axis] = all_below[axis] && p[axis] < -p.w;
      all_above[axis] = all_above[axis] && p[axis] > p.w;
    }
  }
  return !glm::any(all_below) && !glm::any(all_above);
}

// Returns the squared distance of an object from the eye.
double distance2(const Scene& scene, std::size_t object, const glm::dvec3& eye) {
  const SceneObject& o = scene.objects[object];
  const glm::dvec3 d = glm::dvec3(o.world_from_object * glm::dvec4(scene.mesh(o).center(), 1.0)) - eye;
  return glm::dot(d, d);
}

std::vector<std::size_t> drawing_order(const Scene& scene, const glm::dvec3& eye) {
  std::vector<std::size_t> order(scene.objects.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto surface = [&](std::size_t i) { return scene.material(scene.objects[i]).surface; };
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    if (surface(a) != surface(b)) return surface(a) < surface(b);
    if (surface(a) == SceneSurface::blended) return distance2(scene, a, eye) > distance2(scene, b, eye);
    if (scene.culls_objects) return distance2(scene, a, eye) < distance2(scene, b, eye);
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
    case SceneKind::street: return make_street(kTownSize);
    case SceneKind::detail: return make_detail(kDetailTriangles);
    case SceneKind::far: return make_far(kFarTriangles);
    case SceneKind::turn: return make_turn(kTurnTriangles);
    case SceneKind::leaves: return make_leaves();
  }
  return {};
}

std::shared_ptr<const Scene> shared_scene(WorkloadAssets& assets, SceneKind kind) {
  return assets.once<Scene>("scene " + std::to_string(static_cast<int>(kind)), [kind] { return make_scene(kind); });
}

SceneView scene_view(const Scene& scene, const SceneCamera& camera, WorkloadSize size) {
  const glm::dmat4 clip_from_world = workload_projection(size, kNear, kFar) * look_at(camera.eye, camera.target, {0, 1, 0});
  const glm::dmat4 light_from_world = light_matrix(scene.light);
  SceneView view{.clip_from_world = glm::mat4(clip_from_world),
                 .light_from_world = glm::mat4(light_from_world),
                 .eye_ws = glm::vec3(camera.eye),
                 .order = {},
                 .casters = {}};
  const auto is_drawn = [&](std::size_t i, const glm::dmat4& matrix) {
    return !scene.culls_objects || may_be_visible(scene, scene.objects[i], matrix);
  };
  for (const std::size_t i : drawing_order(scene, camera.eye)) {
    if (is_drawn(i, clip_from_world)) view.order.push_back(i);
    if (scene.material(scene.objects[i]).surface <= SceneSurface::cutout && is_drawn(i, light_from_world)) view.casters.push_back(i);
  }
  return view;
}

std::vector<SceneView> scene_views(const Scene& scene, const SceneRow& row, WorkloadSize size) {
  std::vector<SceneView> views;
  for (std::size_t i = 0; i < row.pictures; ++i) views.push_back(scene_view(scene, scene.cameras[row.camera + i], size));
  return views;
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
      std::array<const char*, 5> views;
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
      for (std::size_t i = 0; i < k.views.size(); ++i)
        all.push_back({"scene_" + k.name + "_" + std::to_string(i + 1), k.name + ": " + k.views[i], k.kind, i});
    }
    return all;
  }();
  return rows;
}

std::span<const SceneRow> view_rows() {
  static const std::array<SceneRow, 6> rows{{
      {"street", "a town of 2 million triangles, most of them behind the first row of houses", SceneKind::street, 0},
      {"detail", "the head of a statue of 1 million triangles", SceneKind::detail, 0},
      {"far", "40 models of 200,000 triangles, each 60 pixels high", SceneKind::far, 0},
      {"turn", "36 pictures around a statue, each with its shadow map; times are those of all", SceneKind::turn, 0, 36},
      {"turn_kept", "the same 36 pictures with one shadow map; times are those of all", SceneKind::turn, 0, 36, true},
      {"leaves", "alpha-tested foliage with its shadow", SceneKind::leaves, 0},
  }};
  return rows;
}

}  // namespace halfspace
