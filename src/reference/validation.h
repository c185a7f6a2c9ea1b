// SPDX-License-Identifier: Apache-2.0
//
// `halfspace validate`: a scene's shadows held against rays.
#pragma once

#include <string>
#include <vector>

#include "halfspace/reference/shadow_score.h"

namespace halfspace {

struct ValidationOptions {
  int width = 960, height = 540;
  int rays = 1024;  ///< a pixel and light that has a size
};

/// Every light of a scene that casts a shadow, or would if shadow.method were not none.
struct Validation {
  std::vector<ShadowComparison> lights;
  VisibilityScore visibility;
};

/// The name is told in the scores.
Validation validate(const std::string& name, const SceneDescription& scene, const ValidationOptions& options, SceneAssets& assets,
                    const Workers& workers);

/// One object per light, as JSON: an array.
std::string json_report(const Validation& validation);
/// The same as a table for reading.
std::string text_report(const Validation& validation);
/// Light as grey; dark blue where there is nothing to compare.
Image<glm::u8vec4> light_picture(const Image<float>& light);
/// The truth as grey, and over it the map's errors: red falsely dark, blue falsely lit.
Image<glm::u8vec4> difference_picture(const ShadowComparison& comparison);

}  // namespace halfspace
