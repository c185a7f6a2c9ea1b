// SPDX-License-Identifier: Apache-2.0
//
// Choice of the cheapest sufficiently accurate model (SceneAssets::choose_within_error, render/error_budget/approximation_chooser.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// Maximum difference from the image of the same scene with the finest models.
struct AllowedError {
  std::optional<double> edge_px;  ///< maximum distance of silhouettes and shadow edges, in pixels
  std::optional<double> color;    ///< 99.9th percentile, over all pixels, of the largest channel difference, in 8-bit steps
};

/// One key that was chosen.
struct ApproximationChoice {
  std::string key;    ///< dotted path, in the form that --set accepts
  std::string value;  ///< in the form that --set accepts
  std::string why;
  bool is_setting = true;  ///< false: nothing was chosen; `why` says why
};

struct SceneWithinError {
  SceneDescription scene;
  std::vector<ApproximationChoice> choices;  ///< keys that differ from the scene, and keys that could not be chosen
};

}  // namespace halfspace::HS_LANES
