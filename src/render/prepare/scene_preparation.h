// SPDX-License-Identifier: Apache-2.0
//
// The implementation of SceneAssets::prepare: creates the parts of a prepared scene and adds its objects.
#pragma once

#include "halfspace/render/assets/minimum_sizes.h"
#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/assets/warnings.h"
#include "halfspace/render/prepare/detail_maps.h"
#include "halfspace/render/prepare/model_materials.h"
#include "halfspace/render/prepare/model_preparation.h"
#include "halfspace/render/prepare/scene_clusters.h"
#include "halfspace/render/prepare/scene_draws.h"
#include "halfspace/render/prepare/scene_environments.h"
#include "halfspace/render/prepare/scene_lights.h"
#include "halfspace/render/prepare/scene_maps.h"
#include "halfspace/render/prepare/scene_surfaces.h"
#include "halfspace/render/prepare/shape_preparation.h"
#include "halfspace/render/prepare/sphere_preparation.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

class ScenePreparation {
 public:
  // Keeps references to all arguments.
  ScenePreparation(const SceneDescription& scene, int width, int height, const MinimumSizes& minimum, AssetCache& cache,
                   DetailCache* details, Warnings& warnings, const Workers& workers);

  // Returns the prepared scene. Must be called only once.
  PreparedScene prepare();

 private:
  void add_objects();
  void add_particles();
  // Renders the shadow maps, after all objects have been added to `out`.
  void add_shadows(PreparedScene& out);

  const SceneDescription& scene_;
  Warnings& warnings_;
  const Workers& workers_;
  View view_;
  UsedAssets used_;
  SceneDraws draws_;
  SceneClusters clusters_;
  // These refer to the members above them.
  SceneLights lights_;
  SceneMaps maps_;
  SceneEnvironments environments_;
  SceneSurfaces surfaces_;
  DetailMaps details_;
  ModelMaterials materials_;
  ShapePreparation shapes_;
  ModelPreparation models_;
  SpherePreparation spheres_;
};

}  // namespace halfspace::HS_LANES
