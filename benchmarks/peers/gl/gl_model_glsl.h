// SPDX-License-Identifier: Apache-2.0
//
// GLSL versions of MetallicSurface<MetallicStreams::basic> (halfspace/shading/surface/metallic_surface.h), without clearcoat and sheen, and
// of the tone curve that follows it.
#pragma once

#include <string_view>

namespace halfspace {

/// Used by both stages.
inline constexpr std::string_view kModelShared = R"(
vec3 normalize_or_zero(vec3 v) {
  float squared = dot(v, v);
  return v * (squared > 0.0 ? inversesqrt(squared) : 0.0);
}
)";

inline constexpr std::string_view kModelVertex = R"(
layout(location = 0) in vec3 position_os;
layout(location = 1) in vec3 normal_os;
uniform mat4 clip_from_object, world_from_object;
uniform mat3 normal_from_object;
out vec3 position_rws, normal_ws;
void main() {
  position_rws = (world_from_object * vec4(position_os, 1.0)).xyz;
  normal_ws = normalize_or_zero(normal_from_object * normal_os);
  gl_Position = clip_from_object * vec4(position_os, 1.0);
}
)";

/// Needs the macro LIGHTS, the number of directional lights.
inline constexpr std::string_view kModelFragment = R"(
in vec3 position_rws, normal_ws;
uniform vec3 light_towards[LIGHTS], light_diffuse[LIGHTS], light_specular[LIGHTS];
uniform vec3 ambient, harmonics[9];
uniform mat3 map_from_world;
uniform float brightness;
uniform samplerCube radiance;
uniform sampler2D reflectance;
uniform vec3 base, specular_color, emissive;
uniform float metal, surface_roughness, strength, normal_reflectance, two_sided;
out vec4 result;

float largest(vec3 v) { return max(v.x, max(v.y, v.z)); }

float schlick_weight(float cosine) {
  float x = clamp(1.0 - cosine, 0.0, 1.0), x2 = x * x;
  return x2 * x2 * x;
}

float ggx_reflection(float alpha, vec3 n, vec3 h, float n_l, float n_v) {
  float a2 = alpha * alpha, n_h = dot(n, h), rest = 1.0 - a2;
  vec3 sine = cross(n, h);
  float d = max(a2 * n_h * n_h + dot(sine, sine), a2 * a2);
  float masking = n_l * sqrt(n_v * n_v * rest + a2) + n_v * sqrt(n_l * n_l * rest + a2);
  return 0.5 * n_l * (a2 / (d * d)) / masking;
}

vec3 diffuse_environment(vec3 n) {
  vec3 sum = harmonics[0] + harmonics[1] * n.y + harmonics[2] * n.z + harmonics[3] * n.x + harmonics[4] * (n.x * n.y) +
             harmonics[5] * (n.y * n.z) + harmonics[6] * (3.0 * n.z * n.z - 1.0) + harmonics[7] * (n.x * n.z) +
             harmonics[8] * (n.x * n.x - n.y * n.y);
  return max(sum, 0.0);
}

void main() {
  vec3 v = normalize_or_zero(-position_rws), n = normalize_or_zero(normal_ws);
  if (two_sided > 0.0) n = gl_FrontFacing ? n : -n;
  vec3 f0 = mix(min(specular_color * normal_reflectance, 1.0) * strength, base, metal);
  vec3 f90 = mix(vec3(strength), vec3(1.0), metal);
  vec3 diffuse = base * (1.0 - metal);
  float n_v = max(dot(n, v), 1e-4), roughness = clamp(surface_roughness, MIN_ROUGHNESS, 1.0), alpha = roughness * roughness;

  vec3 sum = emissive;
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 l = light_towards[i], h = normalize_or_zero(l + v);
    float n_l = dot(n, l), share = n_l > 0.0 ? 1.0 : 0.0;
    vec3 f = f0 + (f90 - f0) * schlick_weight(dot(v, h));
    float lobe = ggx_reflection(alpha, n, h, max(n_l, 1e-6), n_v);
    sum += light_diffuse[i] * share * (diffuse * (max(n_l, 0.0) * (1.0 - largest(f)))) + light_specular[i] * share * (f * lobe);
  }

  vec2 table = texture(reflectance, vec2(n_v, roughness)).rg;
  vec3 single = f0 * table.x + f90 * table.y;
  float lost = 1.0 - (table.x + table.y);
  vec3 mean = f0 + (f90 - f0) / 21.0;
  vec3 multiple = single * mean * lost / (1.0 - mean * lost);
  vec3 transmitted = diffuse * (1.0 - min(largest(single + multiple), 1.0));
  float smooth_part = 1.0 - alpha;
  vec3 r = mix(n, reflect(-v, n), smooth_part * (sqrt(smooth_part) + alpha));
  vec3 around = ambient * (transmitted + single + multiple) +
                diffuse_environment(map_from_world * n) * brightness * (transmitted + multiple) +
                textureLod(radiance, map_from_world * r, roughness * LAST_LEVEL).rgb * brightness * single;
  result = vec4(sum + around, 1.0);
}
)";

inline constexpr std::string_view kModelToneVertex = R"(
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";
/// ToneCurve::aces per channel, then sRGB.
inline constexpr std::string_view kModelToneFragment = R"(
uniform sampler2D light;
uniform float exposure;
out vec4 result;
void main() {
  vec3 x = max(texelFetch(light, ivec2(gl_FragCoord.xy), 0).rgb, 0.0) * exposure;
  x = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
  result = vec4(mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThanEqual(x, vec3(0.0031308))), 1.0);
}
)";

}  // namespace halfspace
