// SPDX-License-Identifier: Apache-2.0
//
// The cheapest model that is right enough (SceneAssets::fit, render/model/prepare_models.cpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "halfspace/scene/description.h"

namespace halfspace {

/// How far a picture may be from that of the same scene by the finest models.
struct AllowedError {
  std::optional<double> edge_px;  ///< largest distance of silhouettes, and of the edges of shadows, in pixels
  std::optional<double> color;    ///< the 99.9th percentile over pixels of the largest difference of a channel, in 8-bit codes
};

/// One key that was chosen.
struct ModelChoice {
  std::string key;    ///< dotted path, as --set takes it
  std::string value;  ///< as --set takes it
  std::string why;
};

struct FittedScene {
  SceneDescription scene;
  std::vector<ModelChoice> choices;  ///< of the keys that are not the scene's own any more, and of those that could not be chosen
};

}  // namespace halfspace
