// SPDX-License-Identifier: Apache-2.0
//
// Runs a shader's own functions for one fragment, in float. The results are bit-identical to those of shading in SIMD lanes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "explain/pixel_history.h"
#include "halfspace/raster/inspect/inspection.h"

namespace halfspace {

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

/// The factors of the light that a fragment reflects of one source.
struct LightFactors {
  std::string name;
  glm::vec3 diffuse_color{0.0f}, specular_color{0.0f};  ///< of the light, including its intensity
  float n_l = 0.0f;                                     ///< max(n·l, 0), times the attenuation of the light
  float highlight = 0.0f;                               ///< the specular light per unit of light and of the specular factor
  float shadow = 1.0f;                                  ///< 0: in shadow, or the surface faces away from the light
  glm::vec3 diffuse{0.0f}, specular{0.0f};              ///< the terms
};

/// How a fragment reflects light. For the models of shading/light/lighting.h:
///   diffuse term  = color of the light · n_l · shadow · albedo · diffuse
///   specular term = color of the light · highlight · shadow · specular
struct LightingDetail {
  std::string model;  ///< "lambert", "phong", "blinn_phong" or "metallic"; empty if the shader uses no lights
  glm::vec3 albedo{0.0f};
  glm::vec3 diffuse{0.0f}, specular{0.0f};  ///< factors of the material; not for "metallic"
  float shininess = 0.0f;
  std::vector<LightFactors> lights;
};

/// Returns the factors of a fragment's light.
LightingDetail lighting_detail(const SceneShader& shader, const FragmentPlace& place, std::span<const std::string> light_names);

}  // namespace halfspace
