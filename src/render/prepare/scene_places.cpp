// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/scene_places.h"

#include "halfspace/geometry/camera.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace::HS_LANES {

const CameraDescription& camera_of(const SceneDescription& scene) {
  for (const auto& [name, camera] : scene.cameras) {
    if (name == scene.head.camera) return camera;
  }
  return scene.cameras.front().second;
}

std::vector<glm::dmat4> places_of(const SceneDescription& scene, const ObjectDescription& o) {
  glm::dmat4 whole = world_from_object(o.placement);
  for (const ObjectDescription* p = find_named(scene.objects, o.parent); p != nullptr; p = find_named(scene.objects, p->parent))
    whole = world_from_object(p->placement) * whole;
  if (o.instances.empty()) return {whole};
  std::vector<glm::dmat4> places;
  for (const Placement& p : o.instances) places.push_back(whole * world_from_object(p));
  return places;
}

void place_surface(SurfaceUniforms& s, const View& view, glm::dmat4 world) {
  s.clip_from_object = glm::mat4(view.clip_from_world * world);
  world[3] -= glm::dvec4(view.eye_ws, 0.0);
  s.world_from_object = glm::mat4(world);
  s.normal_from_object = normal_matrix(world);
  s.handedness = glm::determinant(glm::dmat3(world)) < 0 ? -1.0f : 1.0f;
}

}  // namespace halfspace::HS_LANES
