// SPDX-License-Identifier: Apache-2.0
//
// Draws objects of shape `file`: model files with their own meshes and materials.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "halfspace/model/pose/pose.h"
#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/assets/warnings.h"
#include "halfspace/render/prepare/detail_maps.h"
#include "halfspace/render/prepare/model_detail.h"
#include "halfspace/render/prepare/model_materials.h"
#include "halfspace/render/prepare/scene_clusters.h"
#include "halfspace/render/prepare/scene_draws.h"
#include "halfspace/render/prepare/scene_surfaces.h"
#include "halfspace/render/prepare/surface_draw.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

/// Returns the cache key of a model file.
std::string model_recipe(const std::filesystem::path& file, bool allow_outside);

/// Reports the warnings of the reader of a model file.
void warn_of(const std::filesystem::path& file, const Model& model, const Warnings& warnings);

class ModelPreparation {
 public:
  // Keeps references to all arguments.
  ModelPreparation(const SceneDescription& scene, const View& view, ModelMaterials& materials, SceneSurfaces& surfaces, DetailMaps& details,
                   SceneClusters& clusters, UsedAssets& used, Warnings& warnings, SceneDraws& draws, DetailCache* cache,
                   const Workers& workers)
      : scene_(scene),
        view_(view),
        materials_(materials),
        surfaces_(surfaces),
        details_(details),
        clusters_(clusters),
        used_(used),
        warnings_(warnings),
        draws_(draws),
        detail_(view, used, cache, workers) {}

  // object: index in the scene's objects. path: the path of the object, for error messages.
  void add(int object, const std::string& path, const ObjectDescription& o);

 private:
  std::shared_ptr<const ModelAsset> model_asset(const ObjectDescription& o, const std::string& where);
  void add_part(int object, const ObjectDescription& o, const std::string& path, const std::shared_ptr<const ModelAsset>& model,
                const PosedMesh& part, const std::shared_ptr<const Indices>& indices, const glm::dmat4& world);
  void add_replaced_part(int object, const ObjectDescription& o, const std::string& path, const MeshStreams& streams,
                         const std::shared_ptr<const Indices>& indices, const Clusters* clusters, const glm::dmat4& world);

  const SceneDescription& scene_;
  const View& view_;
  ModelMaterials& materials_;
  SceneSurfaces& surfaces_;
  DetailMaps& details_;
  SceneClusters& clusters_;
  UsedAssets& used_;
  Warnings& warnings_;
  SceneDraws& draws_;
  ModelDetail detail_;
};

}  // namespace halfspace::HS_LANES
