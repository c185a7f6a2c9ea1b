// SPDX-License-Identifier: Apache-2.0
//
// GLSL versions of the shaders of tests/conformance/shaders.h.
#pragma once

namespace halfspace::test::conformance_glsl {

inline constexpr const char* kShared = R"(#version 450 core
    uniform float mode;
    uniform float value;
    )";
inline constexpr const char* kViewportShared = R"(#version 450 core
    #extension GL_ARB_shader_viewport_layer_array : require
    )";
inline constexpr const char* kViewportVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    layout(location = 2) in vec4 extra;
    out vec4 color;
    void main() {
      color = in_color;
      gl_Position = pos_clip;
      gl_PointSize = 3.0;
      gl_ViewportIndex = int(extra.x);
    })";
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
inline constexpr const char* kCullVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    layout(location = 2) in vec4 extra;
    out vec4 color;
    out gl_PerVertex { vec4 gl_Position; float gl_PointSize; float gl_ClipDistance[2]; float gl_CullDistance[2]; };
    void main() {
      color = in_color;
      gl_Position = pos_clip;
      gl_PointSize = 4.0;
      for (int i = 0; i < 2; ++i) {
        gl_ClipDistance[i] = extra[i];
        gl_CullDistance[i] = extra[i + 2];
      }
    })";
inline constexpr const char* kSampleInputsFragment = R"(
    out vec4 fragment;
    void main() {
      fragment = mode == 0.0 ? vec4(float(gl_SampleID) / 8.0, 0.0, 0.0, 1.0) : vec4(gl_SamplePosition, 0.0, 1.0);
    })";
inline constexpr const char* kSampleMaskInFragment = R"(
    out vec4 fragment;
    void main() { fragment = vec4(float(gl_SampleMaskIn[0]) / 255.0, 0.0, 0.0, 1.0); })";
inline constexpr const char* kSampleMaskFragment = R"(
    out vec4 fragment;
    void main() {
      gl_SampleMask[0] = int(value);
      fragment = vec4(1.0);
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
// The geometry function of conformance::GeometryShader follows a line with its layout.
inline constexpr const char* kGeometryVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    out vec4 vertex_color;
    flat out int instance;
    void main() {
      vertex_color = in_color;
      instance = gl_InstanceID;
      gl_Position = pos_clip;
    })";
inline constexpr const char* kGeometryBody = R"(
    in vec4 vertex_color[];
    flat in int instance[];
    flat out vec4 f;
    void emit_at(int i, vec2 offset, vec4 color) {
      vec4 p = gl_in[i].gl_Position * 0.5;
      precise vec2 xy = p.xy + offset * p.w;
      gl_Position = vec4(xy, p.zw);
      f = color;
      EmitVertex();
    }
    void main() {
      int n = gl_in.length();
      if (mode == 0.0) {
        for (int i = 0; i < n; ++i) {
          emit_at(i, vec2(0.0), vertex_color[i]);
          if (n < 3) emit_at(i, vec2(0.25, -0.25), vertex_color[i]);
          if (n < 3) emit_at(i, vec2(0.25, 0.25), vertex_color[i]);
        }
      } else if (mode == 1.0) {
        int vertices = int(value) % 4, ends = int(value) / 4;
        for (int i = 0; i < n; ++i) {
          for (int k = 0; k < vertices; ++k) emit_at(i, vec2(k == 0 ? 0.0 : 0.25, k == 2 ? 0.25 : 0.0), vertex_color[i]);
          for (int k = 0; k < ends; ++k) EndPrimitive();
        }
      } else {
        float invocation = float(gl_InvocationID) / 32.0;
        vec4 color = vec4(float(gl_PrimitiveIDIn) / 16.0, float(instance[0]) / 4.0, invocation, 1.0);
        if (((gl_PrimitiveIDIn + gl_InvocationID) & 3) == 1) return;
        for (int i = 0; i < n; ++i) emit_at(i, vec2(0.5, -0.5) * invocation, color);
      }
    })";
inline constexpr const char* kGeometryFragment = R"(
    flat in vec4 f;
    out vec4 fragment;
    void main() { fragment = f; })";
// The tessellation functions of conformance::TessellationShader follow a line with their layout.
inline constexpr const char* kTessellationVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    out vec4 vertex_color;
    void main() {
      vertex_color = in_color;
      gl_Position = pos_clip;
    })";
inline constexpr const char* kControlBody = R"(
    in vec4 vertex_color[];
    patch out vec4 patch_color;
    void main() {
      gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
      patch_color = vertex_color[0];
      for (int i = 0; i < 4; ++i) gl_TessLevelOuter[i] = mode == 0.0 ? value : value * (0.5 + 0.25 * float(i));
      gl_TessLevelInner[0] = value;
      gl_TessLevelInner[1] = mode == 0.0 ? value : value * 0.5;
      if (mode == 2.0 && (gl_PrimitiveID & 1) == 1) gl_TessLevelOuter[1] = 0.0;
    })";
inline constexpr const char* kEvaluationBody = R"(
    patch in vec4 patch_color;
    flat out vec4 f;
    void main() {
      f = patch_color;
      vec3 at = gl_TessCoord;
      precise vec4 p;
      if (gl_PatchVerticesIn == 3) {
        p = gl_in[0].gl_Position * at.x + gl_in[1].gl_Position * at.y + gl_in[2].gl_Position * at.z;
      } else {
        float u = 1.0 - at.x, v = 1.0 - at.y;
        p = (gl_in[0].gl_Position * u + gl_in[1].gl_Position * at.x) * v + (gl_in[3].gl_Position * u + gl_in[2].gl_Position * at.x) * at.y;
      }
      gl_Position = p;
    })";
inline constexpr const char* kLayerVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    layout(location = 2) in vec4 extra;
    out vec4 color;
    void main() {
      color = in_color;
      gl_Position = pos_clip;
      gl_PointSize = 3.0;
      gl_Layer = int(extra.x);
    })";
inline constexpr const char* kLayerFragment = R"(
    in vec4 color;
    out vec4 fragment;
    void main() { fragment = vec4(color.xy, float(gl_Layer) * (16.0 / 255.0), color.w); })";
// The geometry function of conformance::LayerGeometryShader follows a line with its layout.
inline constexpr const char* kLayerGeometryBody = R"(
    in vec4 vertex_color[];
    out vec4 color;
    void main() {
      int n = gl_in.length();
      for (int i = 0; i < 6 / invocations; ++i) {
        int layer = gl_InvocationID + i;
        if (mode == 1.0 && ((gl_PrimitiveIDIn + layer) & 3) == 1) continue;
        for (int k = 0; k < n; ++k) {
          color = vertex_color[k];
          gl_Position = gl_in[k].gl_Position;
          gl_PointSize = 3.0;
          gl_Layer = layer;
          EmitVertex();
        }
        EndPrimitive();
      }
    })";
// With the type of the integer attribute.
inline constexpr const char* kSignedShared = R"(#version 450 core
    #define IVEC ivec4
    uniform float value;
    )";
inline constexpr const char* kUnsignedShared = R"(#version 450 core
    #define IVEC uvec4
    uniform float value;
    )";
inline constexpr const char* kArraysVertex = R"(
    layout(location = 0) in vec4 position;
    layout(location = 1) in vec4 in_color;
    layout(location = 2) in IVEC in_integers;
    layout(location = 3) in vec4 in_last;
    flat out vec4 color;
    flat out IVEC integers;
    flat out vec4 last;
    void main() {
      color = in_color;
      integers = in_integers;
      last = in_last;
      gl_Position = vec4((position.x + 8.0 * float(gl_InstanceID)) * value - position.w, position.y * value - position.w, position.zw);
    })";
inline constexpr const char* kArraysFragment = R"(
    flat in vec4 color;
    flat in IVEC integers;
    flat in vec4 last;
    layout(location = 0) out vec4 color_0;
    layout(location = 1) out ivec4 color_1;
    layout(location = 2) out vec4 color_2;
    void main() {
      color_0 = color;
      color_1 = ivec4(integers);
      color_2 = last;
    })";
inline constexpr const char* kOutputsVertex = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    layout(location = 2) in vec4 extra;
    out vec4 color;
    flat out vec4 numbers;
    void main() {
      color = in_color;
      numbers = extra;
      gl_Position = pos_clip;
    })";
// The outputs and a main function that calls these follow.
inline constexpr const char* kOutputsFunctions = R"(
    in vec4 color;
    flat in vec4 numbers;
    vec4 fraction(float i) { return color * (1.0 - 0.25 * i); }
    ivec4 integers(float i) { return ivec4(numbers) * int(value) + ((ivec4(0, 1, 2, 3) + int(gl_FragCoord.x) + int(i)) & 3); }
    )";
inline constexpr const char* kFourFragment = R"(
    in vec4 color;
    in vec4 other;
    layout(location = 0) out vec4 color_0;
    layout(location = 1) out vec4 color_1;
    layout(location = 2) out vec4 color_2;
    layout(location = 3) out vec4 color_3;
    void main() {
      color_0 = color;
      color_1 = other;
      color_2 = color * 0.5 + other * 0.5;
      color_3 = color * 0.75 + other * 0.25;
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
