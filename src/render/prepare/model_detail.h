// SPDX-License-Identifier: Apache-2.0
//
// Simplified meshes of model files. Their outlines are off by at most a given number of pixels (model_error,
// docs/explanation/max_error.md).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/render/assets/detail_cache.h"
#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

// Returns all triangles of a mesh. The result keeps the model alive.
std::shared_ptr<const Indices> all_indices(const std::shared_ptr<const ModelAsset>& model, int mesh);

class ModelDetail {
 public:
  // Keeps references to all arguments. cache: null if simplified meshes are not kept.
  ModelDetail(const View& view, UsedAssets& used, DetailCache* cache, const Workers& workers)
      : view_(view), used_(used), cache_(cache), workers_(workers) {}

  // Returns the triangles of a mesh with which its outline is off by at most error_px, or all of them. Adds them to the report.
  std::shared_ptr<const Indices> indices_of(const std::shared_ptr<const ModelAsset>& model, int mesh, const glm::dmat4& world_from_mesh,
                                            double error_px, SimplifiedObject& report);

 private:
  // original: made if it is needed.
  SimplifiedMesh simplified_mesh(const ModelMesh& mesh, int step, std::optional<OriginalMesh>& original);

  const View& view_;
  UsedAssets& used_;
  DetailCache* cache_;
  const Workers& workers_;
};

}  // namespace halfspace::HS_LANES
