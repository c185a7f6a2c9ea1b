// SPDX-License-Identifier: Apache-2.0
//
// What the oracle knows about a shader without its type: its properties, and the outputs of its functions.
#pragma once

#include <span>
#include <vector>

#include "halfspace/shading/shader_traits.h"
#include "oracle/window.h"

namespace halfspace::oracle {

/// Properties of a shader, for the parts of the oracle that do not depend on its type.
struct ShaderFacts {
  bool has_fragment = true;
  bool writes_depth = false;
  bool tests_early = false, runs_per_sample = false;
  ConservativeDepth conservative_depth = ConservativeDepth::any;
  std::span<const Interpolation> interpolations;
};

/// The output of the vertex function.
struct ShadedVertex {
  glm::vec4 pos_clip{};
  float point_size = 1.0f;
  std::vector<float> clip_distances, cull_distances;
  int32_t layer = 0, viewport = 0;
  bool has_bounds = false;  ///< if set, low and high (NDC) are used instead of the size
  glm::vec2 low{}, high{};
  std::vector<float> varyings;
};

/// Where a fragment function is evaluated.
struct Place {
  Point at, centroid;  ///< of smooth and of centroid varyings
  int sample = 0;      ///< if it runs per sample
  int samples = 1;     ///< of a pixel
  uint32_t mask = 1;   ///< the samples that it is for
};

/// The output of the fragment function.
struct FragmentResult {
  std::vector<glm::vec4> colors;
  bool keep = true;
  float depth = 0.0f;
  uint32_t sample_mask = ~0u;
};

}  // namespace halfspace::oracle
