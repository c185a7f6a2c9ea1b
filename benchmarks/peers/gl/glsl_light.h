// SPDX-License-Identifier: Apache-2.0
//
// GLSL versions of the formulas in workload_shading.h and workload_shadow.h.
#pragma once

#include <string_view>

namespace halfspace {

inline constexpr std::string_view kGlslLight = R"(
// Both return the factor for the surface color and the term that is added to the product.
vec2 blinn_phong(vec3 normal, vec3 l, vec3 v) {
  vec3 n = normalize(normal), h = normalize(l + v);
  return vec2(0.08 + 0.8 * max(dot(n, l), 0.0), 0.4 * pow(max(dot(n, h), 0.0), 48.0));
}
vec2 phong(vec3 n, vec3 l, vec3 v) {
  vec3 r = reflect(-l, n);
  return vec2(0.1 + 0.7 * max(dot(n, l), 0.0), 0.3 * pow(max(dot(r, v), 0.0), 32.0));
}
)";

// unoccluded_fraction in workload_shadow.h. The map is sampled with GL_NEAREST and GL_CLAMP_TO_EDGE (see GlTarget).
inline constexpr std::string_view kGlslShadow = R"(
float unoccluded_fraction(sampler2D map, mat4 light_from_world, float bias, vec3 position_ws) {
  vec4 q = light_from_world * vec4(position_ws, 1.0);
  vec3 s = 0.5 * q.xyz / q.w + 0.5;
  float sum = 0.0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) sum += s.z - bias <= textureLod(map, s.xy + vec2(dx, dy) / 2048.0, 0.0).r ? 1.0 : 0.0;
  }
  return sum / 9.0;
}
)";

}  // namespace halfspace
