// SPDX-License-Identifier: Apache-2.0
//
// The terms of the light of a frame. A term is rendered by the same shaders, with the uniforms of all other terms set to zero.
#pragma once

#include <string>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

enum class TermKind : uint8_t { ambient, diffuse, specular, emitted, reflected, background };

/// A term of the light that reaches the eye.
struct LightTerm {
  TermKind kind;
  int light = -1;  ///< index in PreparedScene::lights, for diffuse and specular
  std::string name;
};

/// Returns the light terms that the shaders of a scene can use.
std::vector<LightTerm> light_terms(const PreparedScene& scene);

/// Whether surfaces receive the shadows of the lights.
enum class TermShadow : bool { without, with };

/// Returns the linear light of one term. In exact arithmetic, the sum over all terms is the light of the frame.
Image<glm::vec4> render_term(const PreparedScene& scene, const LightTerm& term, TermShadow shadow, const Workers& workers);

}  // namespace halfspace
