// SPDX-License-Identifier: Apache-2.0
//
// Choice of the cheapest sufficiently accurate model (SceneAssets::fit, render/model/model_chooser.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "halfspace/scene/description.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Maximum difference from the image of the same scene with the finest models.
struct AllowedError {
  std::optional<double> edge_px;  ///< maximum distance of silhouettes and shadow edges, in pixels
  std::optional<double> color;    ///< 99.9th percentile, over all pixels, of the largest channel difference, in 8-bit steps
};

/// One key that was chosen.
struct ModelChoice {
  std::string key;    ///< dotted path, in the form that --set accepts
  std::string value;  ///< in the form that --set accepts
  std::string why;
  bool is_setting = true;  ///< false: nothing was chosen; `why` says why
};

struct FittedScene {
  SceneDescription scene;
  std::vector<ModelChoice> choices;  ///< keys that differ from the scene, and keys that could not be chosen
};

}  // namespace halfspace::inline HS_LANES_NAMESPACE
