// SPDX-License-Identifier: Apache-2.0
//
// Draws objects with generated meshes.
#pragma once

#include <memory>
#include <string>

#include "halfspace/render/prepare/adaptive_meshes.h"
#include "halfspace/render/prepare/detail_maps.h"
#include "halfspace/render/prepare/scene_clusters.h"
#include "halfspace/render/prepare/scene_draws.h"
#include "halfspace/render/prepare/scene_lights.h"
#include "halfspace/render/prepare/scene_meshes.h"
#include "halfspace/render/prepare/scene_surfaces.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

class ShapePreparation {
 public:
  // Keeps references to all arguments except the meshes.
  ShapePreparation(const SceneDescription& scene, const View& view, const SceneLights& lights, const SceneMeshes& meshes,
                   const AdaptiveMeshes& adaptive, SceneSurfaces& surfaces, DetailMaps& details, SceneClusters& clusters, SceneDraws& draws)
      : scene_(scene),
        view_(view),
        lights_(lights),
        meshes_(meshes),
        adaptive_(adaptive),
        surfaces_(surfaces),
        details_(details),
        clusters_(clusters),
        draws_(draws) {}

  // object: index in the scene's objects. path: the path of the object, for error messages.
  void add(int object, const std::string& path, const ObjectDescription& o);

 private:
  std::shared_ptr<const MeshAsset> mesh_of(int object, const std::string& path, const ObjectDescription& o, const Relief& relief,
                                           const std::vector<glm::dmat4>& places);
  void add_shadow_catcher(int object, const ObjectDescription& o, const MeshAsset& mesh, const std::shared_ptr<const Indices>& indices);

  const SceneDescription& scene_;
  const View& view_;
  const SceneLights& lights_;
  SceneMeshes meshes_;
  AdaptiveMeshes adaptive_;
  SceneSurfaces& surfaces_;
  DetailMaps& details_;
  SceneClusters& clusters_;
  SceneDraws& draws_;
};

}  // namespace halfspace::HS_LANES
