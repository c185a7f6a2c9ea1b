// SPDX-License-Identifier: Apache-2.0
//
// Draws the objects of a scene to a pass.
#pragma once

#include <optional>

#include "halfspace/raster/clusters.h"
#include "halfspace/raster/depth_pyramid.h"
#include "halfspace/raster/pass.h"
#include "scenes/scene_shaders.h"

namespace halfspace {

/// A scene, seen by a camera, with everything that its draw calls need.
struct SceneJob {
  const Scene& scene;
  const SceneView& view;
  std::span<const Indices> meshes;
  std::span<const std::optional<Clusters>> clusters;  ///< of each mesh; those of small meshes do not pay
  SceneUniforms uniforms;                             ///< uniforms of the whole scene; each draw call sets those of its material
  const DepthPyramid* hidden_by = nullptr;            ///< of what earlier passes have drawn
};

void draw_scene_depth(Pass& pass, const SceneJob& job, const SceneObject& object);
void draw_scene_opaque(Pass& pass, const SceneJob& job, const SceneObject& object);
void draw_scene_cutout(Pass& pass, const SceneJob& job, const SceneObject& object);
void draw_scene_unlit(Pass& pass, const SceneJob& job, const SceneObject& object);
void draw_scene_blended(Pass& pass, const SceneJob& job, const SceneObject& object);

/// Lets a draw of an object skip the clusters of its mesh that cannot be seen. culling: without clusters.
inline void cull_scene_clusters(DrawState& state, const SceneJob& job, const SceneObject& object, ClusterCulling culling) {
  const std::optional<Clusters>& clusters = job.clusters[object.mesh];
  if (!clusters) return;
  culling.clusters = &*clusters;
  state.clusters = culling;
}

/// Draws an object with a shader that derives from SceneUniforms.
template <class S>
void draw_scene_object(Pass& pass, const SceneJob& job, const SceneObject& object) {
  const std::vector<SceneVertex>& v = job.scene.vertices;
  const SceneMaterial& material = job.scene.material(object);
  S shader{job.uniforms};
  shader.world_from_object = glm::mat4(object.world_from_object);
  shader.map = job.scene.textures[material.texture].get();
  shader.tint = material.tint;
  shader.gloss = material.gloss;
  shader.alpha = material.alpha;
  DrawState state = scene_state(material);
  cull_scene_clusters(state, job, object, {nullptr, shader.clip_from_world, shader.world_from_object, job.hidden_by});
  pass.draw(shader, make_vertex_view(stream(v, &SceneVertex::position), stream(v, &SceneVertex::normal), stream(v, &SceneVertex::uv)),
            job.meshes[object.mesh], state);
}

}  // namespace halfspace
