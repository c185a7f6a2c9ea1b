// SPDX-License-Identifier: Apache-2.0
//
// `halfspace validate`: compares the shadows of a scene with ray-cast shadows.
#pragma once

#include <string>
#include <vector>

#include "halfspace/reference/shadow_score.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace::HS_LANES {

struct ValidationOptions {
  int width = 960, height = 540;
  int rays = 1024;  ///< per pixel and light, for lights that have a size
};

/// Results for every light of a scene that is set to cast a shadow, even if shadow.method is none.
struct Validation {
  std::vector<ShadowComparison> lights;
  VisibilityScore visibility;
};

/// Validates all lights of a scene. `name` is stored in the scores.
Validation validate(const std::string& name, const SceneDescription& scene, const ValidationOptions& options, SceneAssets& assets,
                    const Workers& workers);

/// Formats the results as a JSON array with one object per light.
std::string json_report(const Validation& validation);
/// Formats the results as a text table.
std::string text_report(const Validation& validation);
/// Converts light to gray. Pixels that were not compared are dark blue.
Image<glm::u8vec4> light_picture(const Image<float>& light);
/// Draws the reference in gray with the errors of the map on top: red is wrongly shadowed, blue wrongly lit.
Image<glm::u8vec4> difference_picture(const ShadowComparison& comparison);

}  // namespace halfspace::HS_LANES
