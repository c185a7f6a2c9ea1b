// SPDX-License-Identifier: Apache-2.0
//
// Runs a shader's own functions for one fragment, in float. The results are bit-identical to those of shading in SIMD lanes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "halfspace/explain/pixel_history.h"
#include "halfspace/raster/inspect/inspection.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// The triangle and the position of a fragment.
struct FragmentPlace {
  const InspectedTriangle& triangle;
  glm::ivec2 pixel;   ///< in window coordinates, from the lower left
  SamplePosition at;  ///< position within the pixel where the shader is evaluated
  float depth;
};

/// The values of a fragment; see FragmentDetail.
struct FragmentValues {
  std::string shader;
  glm::vec3 barycentrics{1.0f, 0.0f, 0.0f};
  float inv_w = 0.0f;
  std::vector<NamedValue> varyings, terms, factors;
  glm::vec4 color{0.0f};
};

/// Returns the values of a fragment. light_names: the names of the scene's lights, in order.
FragmentValues fragment_values(const SceneShader& shader, const FragmentPlace& place, std::span<const std::string> light_names);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
