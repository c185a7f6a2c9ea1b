// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/surface/depth_only.h"
#include "scenes/scene_draw.h"

namespace halfspace {

void draw_scene_cutout(Pass& pass, const SceneJob& job, const SceneObject& object) { draw_scene_object<SceneCutout>(pass, job, object); }

void draw_scene_depth(Pass& pass, const SceneJob& job, const SceneObject& object) {
  const std::vector<SceneVertex>& v = job.scene.vertices;
  const glm::mat4 clip_from_object = job.view.light_from_world * glm::mat4(object.world_from_object);
  const Indices& indices = job.meshes[object.mesh];
  const SceneMaterial& material = job.scene.material(object);
  DrawState state = scene_shadow_state();
  cull_scene_clusters(state, job, object, {nullptr, clip_from_object});
  if (material.surface == SceneSurface::cutout) {
    const auto view = make_vertex_view(stream(v, &SceneVertex::position), stream(v, &SceneVertex::uv));
    pass.draw_depth(SceneCutoutDepth{clip_from_object, job.scene.textures[material.texture].get()}, view, indices, state);
  } else {
    pass.draw_depth(DepthOnly{clip_from_object}, make_vertex_view(stream(v, &SceneVertex::position)), indices, state);
  }
}

}  // namespace halfspace
