// SPDX-License-Identifier: Apache-2.0
//
// GLSL versions of the shaders of tests/conformance/shaders.h.
#pragma once

namespace halfspace::test::conformance_glsl {

inline constexpr const char* kShared = R"(#version 450 core
    uniform float mode;
    uniform float value;
    )";
inline constexpr const char* kVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    layout(location = 2) in vec4 extra;
    out vec4 color;
    out vec4 other;
    void main() {
      color = in_color;
      other = extra;
      gl_Position = pos_clip;
    })";
inline constexpr const char* kColorVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    smooth out vec4 s;
    flat out vec4 f;
    noperspective out vec4 l;
    centroid out vec4 c;
    void main() {
      s = f = l = c = in_color;
      gl_Position = pos_clip;
    })";
inline constexpr const char* kColorFragment = R"(
    smooth in vec4 s;
    flat in vec4 f;
    noperspective in vec4 l;
    centroid in vec4 c;
    out vec4 fragment;
    void main() { fragment = mode == 0.0 ? s : mode == 1.0 ? f : mode == 2.0 ? l : c; })";
inline constexpr const char* kClipVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    layout(location = 2) in vec4 extra;
    out vec4 color;
    out gl_PerVertex { vec4 gl_Position; float gl_PointSize; float gl_ClipDistance[4]; };
    void main() {
      color = in_color;
      gl_Position = pos_clip;
      gl_PointSize = 4.0;
      for (int i = 0; i < 4; ++i) gl_ClipDistance[i] = extra[i];
    })";
inline constexpr const char* kPlainFragment = R"(
    in vec4 color;
    out vec4 fragment;
    void main() { fragment = color; })";
inline constexpr const char* kCutoutFragment = R"(
    in vec4 color;
    out vec4 fragment;
    void main() {
      if (!(color.x >= value)) discard;
      fragment = color;
    })";
inline constexpr const char* kDepthFragment = R"(
    in vec4 color;
    out vec4 fragment;
    void main() {
      fragment = color;
      gl_FragDepth = color.y;
    })";
inline constexpr const char* kPointVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    layout(location = 2) in vec4 extra;
    out vec4 color;
    void main() {
      color = in_color;
      gl_Position = pos_clip;
      gl_PointSize = extra.x;
    })";
inline constexpr const char* kPointFragment = R"(
    in vec4 color;
    out vec4 fragment;
    void main() { fragment = vec4(gl_PointCoord, color.zw); })";
inline constexpr const char* kDerivativeFragment = R"(
    in vec4 other;
    out vec4 fragment;
    void main() {
      vec2 dx = dFdxCoarse(other.xy), dy = dFdyCoarse(other.xy);
      int m = int(mode) % 3;
      fragment = vec4((m == 0 ? dx : m == 1 ? dy : abs(dx) + abs(dy)) * value, 0.0, 1.0);
    })";
inline constexpr const char* kTextureFragment = R"(
    uniform sampler2D image;
    in vec4 other;
    out vec4 fragment;
    void main() { fragment = mode == 0.0 ? texture(image, other.xy) : textureLod(image, other.xy, value); })";
inline constexpr const char* kInstanceVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    layout(location = 2) in vec4 extra;
    out vec4 color;
    void main() {
      float number = float(gl_InstanceID);
      color = vec4(in_color.x, extra.w, number * (1.0 / 32.0), in_color.w);
      precise float x = pos_clip.x + number * value + extra.x;
      gl_Position = vec4(x, pos_clip.y + extra.y, pos_clip.zw);
    })";
inline constexpr const char* kTwoFragment = R"(
    in vec4 color;
    in vec4 other;
    layout(location = 0, index = 0) out vec4 first;
    layout(location = 0, index = 1) out vec4 second;
    void main() {
      first = color;
      second = other;
    })";

}  // namespace halfspace::test::conformance_glsl
