// SPDX-License-Identifier: Apache-2.0
//
// Bounds of the clusters of large meshes (raster/clusters.h). They cost about as much as drawing a mesh a few times, so a mesh has them
// from the second frame on that draws it.
#pragma once

#include <memory>
#include <set>
#include <string>

#include "halfspace/raster/clusters.h"
#include "halfspace/render/assets/used_assets.h"

namespace halfspace::HS_LANES {

class SceneClusters {
 public:
  // Keeps a reference to the argument.
  explicit SceneClusters(UsedAssets& used) : used_(used) {}

  // Returns the clusters of a mesh, or null if it has none. `indices` must own the positions: both live equally long and never change.
  const Clusters* of(const std::shared_ptr<const Indices>& indices, std::span<const glm::vec3> positions);

 private:
  UsedAssets& used_;
  std::set<std::string> new_;  // recipes of meshes that no frame before has drawn
};

}  // namespace halfspace::HS_LANES
