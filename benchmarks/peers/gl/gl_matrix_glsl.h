// SPDX-License-Identifier: Apache-2.0
//
// GLSL versions of the shaders in matrix_shaders.h. Macros select the parts that a row uses.
#pragma once

#include <string_view>

namespace halfspace {

inline constexpr std::string_view kMatrixVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec2 uv_in;
uniform mat4 clip_from_world;
#if defined(VARYINGS)
#define VARYING(n) out vec4 v##n;
ALL_VARYINGS
#else
out vec3 normal;
out vec2 uv;
#endif
void main() {
  vec3 p = position;
#ifdef INSTANCED
  int column = gl_InstanceID % COLUMNS, row = gl_InstanceID / COLUMNS;
  p = p * SCALE + vec3(0.3 * (float(column) - 0.5 * float(COLUMNS - 1)), 0.34 * (float(row) - 0.5 * float(ROWS - 1)), 0.0);
#endif
#if defined(VARYINGS)
#undef VARYING
#define VARYING(n) v##n = p.xyzx / float(n + 1);
  ALL_VARYINGS
#else
  normal = normal_in;
  uv = uv_in;
#endif
  gl_Position = clip_from_world * vec4(p, 1.0);
}
)";

inline constexpr std::string_view kMatrixFragment = R"(
layout(location = 0, index = 0) out vec4 result;
uniform sampler2D maps[8];
uniform float threshold;
#if defined(VARYINGS)
#define VARYING(n) in vec4 v##n;
ALL_VARYINGS
void main() {
  float sum = 0.0;
#undef VARYING
#define VARYING(n) sum += (v##n.x + v##n.y) + (v##n.z + v##n.w);
  ALL_VARYINGS
  result = vec4(vec3(0.5 + sum * (1.0 / float(max(VARYINGS, 1)))), 1.0);
}
#else
in vec3 normal;
in vec2 uv;
float diffuse() { return 0.2 + 0.8 * max(dot(normalize(normal), LIGHT), 0.0); }
vec4 lit_texel() {
  vec4 color = texture(maps[0], uv);
  return vec4(color.rgb * diffuse(), color.a);
}
#if defined(LIT)
void main() {
  vec3 sum = vec3(0.0);
#define LOOKUP(n) sum += texture(maps[n], uv * (1.0 + REPEAT * float(n))).rgb;
  ALL_LOOKUPS
  result = vec4(sum * (diffuse() / float(LIT)), 1.0);
}
#elif defined(ALPHA)
void main() { result = lit_texel(); }
#elif defined(DUAL)
layout(location = 0, index = 1) out vec4 second;
void main() {
  result = lit_texel();
  second = vec4(1.0 - result.rgb, result.a);
}
#elif defined(HOLES)
void main() {
  vec4 color = lit_texel();
  if (color.a < threshold) discard;
  result = vec4(color.rgb, 1.0);
}
#elif defined(DEPTH)
void main() {
  float u = uv.x * 8.0, f = u - floor(u);
  gl_FragDepth = gl_FragCoord.z - 0.002 * f * (1.0 - f);
  result = vec4(lit_texel().rgb, 1.0);
}
#elif defined(CONSTANT)
void main() { result = vec4(0.25, 0.5, 0.75, 1.0); }
#elif defined(COLOR)
void main() { result = vec4(uv, 0.5, 1.0); }
#elif defined(TINT)
void main() { result = vec4(uv, 0.5, 0.5); }
#elif defined(TEXTURE)
void main() { result = vec4(texture(maps[0], uv).rgb, 1.0); }
#else
void main() {
  vec3 c = 0.8 * texture(maps[0], uv).rgb;
  result = vec4(pow(c / (1.0 + c), vec3(1.0 / 2.2)), 1.0);
}
#endif
#endif
)";

}  // namespace halfspace
