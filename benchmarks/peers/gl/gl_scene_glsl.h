// SPDX-License-Identifier: Apache-2.0
//
// GLSL versions of the shaders in scenes/scene_shaders.h. The fragment shaders follow kGlslLight, kGlslShadow and kSceneShading.
#pragma once

#include <string_view>

namespace halfspace {

inline constexpr std::string_view kSceneDepthVertex = R"(
layout(location = 0) in vec3 position_os;
layout(location = 2) in vec2 uv_in;
uniform mat4 clip_from_object;
out vec2 uv;
void main() {
  uv = uv_in;
  gl_Position = clip_from_object * vec4(position_os, 1.0);
}
)";
inline constexpr std::string_view kSceneDepth = "void main() {}\n";
inline constexpr std::string_view kSceneCutoutDepth = R"(
in vec2 uv;
uniform sampler2D map;
void main() {
  if (texture(map, uv).a < 0.5) discard;
}
)";

inline constexpr std::string_view kSceneVertex = R"(
layout(location = 0) in vec3 position_os;
layout(location = 1) in vec3 normal_os;
layout(location = 2) in vec2 uv_in;
uniform mat4 world_from_object, clip_from_world;
out vec3 position_ws, normal_ws;
out vec2 uv;
void main() {
  vec4 position = world_from_object * vec4(position_os, 1.0);
  position_ws = position.xyz;
  normal_ws = mat3(world_from_object) * normal_os;
  uv = uv_in;
  gl_Position = clip_from_world * position;
}
)";

/// Needs the macros BIAS and NORMAL_OFFSET.
inline constexpr std::string_view kSceneShading = R"(
in vec3 position_ws, normal_ws;
in vec2 uv;
uniform mat4 light_from_world;
uniform vec3 eye_ws, to_sun, sun, sky, ground, lamp_ws, lamp, haze, tint;
uniform float haze_distance, gloss, alpha;
uniform sampler2D map, shadow_map;
out vec4 result;
vec3 shade(vec3 base) {
  vec3 n = normalize(normal_ws), to_eye = eye_ws - position_ws, to_lamp = lamp_ws - position_ws;
  float d2 = dot(to_eye, to_eye);
  vec2 sunlight = blinn_phong(n, to_sun, to_eye * inversesqrt(d2));
  float seen = unoccluded_fraction(shadow_map, light_from_world, BIAS, position_ws + n * NORMAL_OFFSET);
  float lamplight = max(dot(n, to_lamp), 0.0) / (1.0 + dot(to_lamp, to_lamp));
  vec3 ambient = ground + (sky - ground) * (0.5 + 0.5 * n.y);
  vec3 diffuse = ambient + sun * (seen * sunlight.x) + lamp * lamplight;
  return mix(base * diffuse + sun * (seen * sunlight.y * gloss), haze, d2 / (d2 + haze_distance * haze_distance));
}
)";

inline constexpr std::string_view kSceneOpaque = R"(
void main() { result = vec4(shade(texture(map, uv).rgb * tint), 1.0); }
)";
inline constexpr std::string_view kSceneCutout = R"(
void main() {
  vec4 color = texture(map, uv);
  if (color.a < 0.5) discard;
  result = vec4(shade(color.rgb * tint), 1.0);
}
)";
inline constexpr std::string_view kSceneUnlit = R"(
in vec2 uv;
uniform vec3 tint;
uniform sampler2D map;
out vec4 result;
void main() { result = vec4(texture(map, uv).rgb * tint, 1.0); }
)";
inline constexpr std::string_view kSceneBlended = R"(
void main() {
  vec4 color = texture(map, uv);
  float facing = 1.0 - abs(dot(normalize(normal_ws), normalize(eye_ws - position_ws))), facing2 = facing * facing;
  float mirrored = facing2 * facing2, opacity = color.a * alpha;
  result = vec4(mix(shade(color.rgb * tint), haze, mirrored), opacity + (1.0 - opacity) * mirrored);
}
)";

}  // namespace halfspace
