// SPDX-License-Identifier: Apache-2.0
//
// Chooses the cheapest models whose image differs from the image of the finest models by at most the allowed error. The result is the scene
// with adjusted mesh resolutions, maps, filters and sample counts, and the reasons for the changes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/error_budget/approximation_choice.h"
#include "halfspace/render/prepare/scene_maps.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

class ApproximationChooser {
 public:
  // Keeps references to all arguments.
  ApproximationChooser(const SceneDescription& scene, const View& view, SceneMaps& maps, UsedAssets& used, const Workers& workers)
      : scene_(scene), view_(view), maps_(maps), used_(used), workers_(workers) {}

  SceneWithinError choose_within_error(const AllowedError& allowed);

 private:
  ObjectDescription chosen_object(const ObjectDescription& authored, const std::string& path, double edge_px, std::optional<double> color,
                                  std::vector<ApproximationChoice>& choices);

  const SceneDescription& scene_;
  const View& view_;
  SceneMaps& maps_;
  UsedAssets& used_;
  const Workers& workers_;
};

}  // namespace halfspace::HS_LANES
