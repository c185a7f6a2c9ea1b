// SPDX-License-Identifier: Apache-2.0
//
// GLSL versions of the formulas in workload_shading.h.
#pragma once

#include <string_view>

namespace halfspace {

inline constexpr std::string_view kGlslLight = R"(
// Both return the factor of the surface color and the term that is added.
vec2 blinn_phong(vec3 normal, vec3 l, vec3 v) {
  vec3 n = normalize(normal), h = normalize(l + v);
  return vec2(0.08 + 0.8 * max(dot(n, l), 0.0), 0.4 * pow(max(dot(n, h), 0.0), 48.0));
}
vec2 phong(vec3 n, vec3 l, vec3 v) {
  vec3 r = reflect(-l, n);
  return vec2(0.1 + 0.7 * max(dot(n, l), 0.0), 0.3 * pow(max(dot(r, v), 0.0), 32.0));
}
)";

}  // namespace halfspace
