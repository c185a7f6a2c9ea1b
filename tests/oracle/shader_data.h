// SPDX-License-Identifier: Apache-2.0
//
// What the oracle knows about a shader without its type: its properties, and the outputs of its functions.
#pragma once

#include <span>
#include <vector>

#include "halfspace/shading/shader_traits.h"

namespace halfspace::oracle {

/// Properties of a shader, for the parts of the oracle that do not depend on its type.
struct ShaderFacts {
  bool has_fragment = true;
  bool writes_depth = false;
  std::span<const Interpolation> interpolations;
};

/// The output of the vertex function.
struct ShadedVertex {
  glm::vec4 pos_clip{};
  float point_size = 1.0f;
  std::vector<float> clip_distances;
  bool has_bounds = false;  ///< if set, low and high (NDC) are used instead of the size
  glm::vec2 low{}, high{};
  std::vector<float> varyings;
};

/// The output of the fragment function.
struct FragmentResult {
  std::vector<glm::vec4> colors;
  bool keep = true;
  float depth = 0.0f;
};

}  // namespace halfspace::oracle
