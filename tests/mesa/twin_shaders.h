// SPDX-License-Identifier: Apache-2.0
//
// Each shader is written twice, for Halfspace and in GLSL, with matching lines. kSharedGlsl is prepended to each kVertexGlsl and
// kFragmentGlsl; uniforms() sets every member as a GLSL uniform.
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::test {

// ---- functions shared by the shaders -----------------------------------------------------------------------------

/// Returns (diffuse, specular) of a point light.
template <class R>
HS_INLINE vec2<R> blinn_phong(const vec3<R>& p, const vec3<R>& n, const glm::vec3& eye, const glm::vec3& light) {
  const vec3<R> N = normalize(n);
  const vec3<R> L = normalize(light - p);
  const vec3<R> H = normalize(L + normalize(eye - p));
  return vec2<R>(R(0.08f) + R(0.8f) * max(dot(N, L), R(0.0f)), R(0.4f) * pow(max(dot(N, H), R(0.0f)), R(48.0f)));
}

/// Prepended to every GLSL source. transform() is our mat4 × vec4; it adds in the same order, which `precise` preserves. level_of_detail()
/// matches the function of that name in shading/texture/texture.h, computed from the differences that GLSL provides.
inline constexpr const char* kSharedGlsl = R"(#version 450 core
    vec4 transform(mat4 m, vec4 p) {
      precise vec4 r = (m[0] * p.x + m[1] * p.y) + (m[2] * p.z + m[3] * p.w);
      return r;
    }

    vec2 blinn_phong(vec3 p, vec3 n, vec3 eye, vec3 light) {
      vec3 N = normalize(n);
      vec3 L = normalize(light - p);
      vec3 H = normalize(L + normalize(eye - p));
      return vec2(0.08 + 0.8 * max(dot(N, L), 0.0), 0.4 * pow(max(dot(N, H), 0.0), 48.0));
    }

    float level_of_detail(vec2 size, vec2 duv_dx, vec2 duv_dy) {
      vec2 dx = duv_dx * size, dy = duv_dy * size;
      return 0.5 * log2(max(dot(dx, dx), dot(dy, dy)));
    })";

// ---- vertex colors with the three interpolation qualifiers ----------------------------------------------------------

/// Perspective-correct colors. Positions are in clip space.
struct SmoothColor {
  template <class R>
  struct Attributes {
    vec4<R> pos_clip;
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    vec4<R> color;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return in.pos_clip;
  }
  static constexpr const char* kVertexGlsl = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    smooth out vec4 color;
    void main() {
      color = in_color;
      gl_Position = pos_clip;
    })";

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color};
  }
  static constexpr const char* kFragmentGlsl = R"(
    smooth in vec4 color;
    out vec4 fragment;
    void main() { fragment = color; })";

  template <class Set>
  void uniforms(const Set&) const {}
};

/// The provoking vertex's color.
struct FlatColor {
  template <class R>
  struct Attributes {
    vec4<R> pos_clip;
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    Flat<vec4<R>> color;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color.value = in.color;
    return in.pos_clip;
  }
  static constexpr const char* kVertexGlsl = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    flat out vec4 color;
    void main() {
      color = in_color;
      gl_Position = pos_clip;
    })";

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color.value};
  }
  static constexpr const char* kFragmentGlsl = R"(
    flat in vec4 color;
    out vec4 fragment;
    void main() { fragment = color; })";

  template <class Set>
  void uniforms(const Set&) const {}
};

/// Colors interpolated linearly in window space, without perspective correction.
struct LinearColor {
  template <class R>
  struct Attributes {
    vec4<R> pos_clip;
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    NoPerspective<vec4<R>> color;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color.value = in.color;
    return in.pos_clip;
  }
  static constexpr const char* kVertexGlsl = R"(
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec4 in_color;
    noperspective out vec4 color;
    void main() {
      color = in_color;
      gl_Position = pos_clip;
    })";

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color.value};
  }
  static constexpr const char* kFragmentGlsl = R"(
    noperspective in vec4 color;
    out vec4 fragment;
    void main() { fragment = color; })";

  template <class Set>
  void uniforms(const Set&) const {}
};

/// A single color for all pixels.
struct OneColor {
  glm::vec4 color{1.0f};

  template <class R>
  struct Attributes {
    vec4<R> pos_clip;
  };
  template <class R>
  struct Varyings {};

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return in.pos_clip;
  }
  static constexpr const char* kVertexGlsl = R"(
    layout(location = 0) in vec4 pos_clip;
    void main() { gl_Position = pos_clip; })";

  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(color.x), R(color.y), R(color.z), R(color.w))};
  }
  static constexpr const char* kFragmentGlsl = R"(
    uniform vec4 color;
    out vec4 fragment;
    void main() { fragment = color; })";

  template <class Set>
  void uniforms(const Set& set) const {
    set("color", color);
  }
};

// ---- Blinn-Phong lighting of a sphere: per pixel, per vertex, per triangle ------------------------------------------

/// Uniforms and attributes shared by the lit shaders.
struct Lit {
  glm::mat4 clip_from_world{1.0f};
  glm::vec3 eye{0.0f}, light{0.0f};
  glm::vec3 base{1.0f};

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
    vec2<R> uv;
  };
  template <class Set>
  void uniforms(const Set& set) const {
    set("clip_from_world", clip_from_world);
    set("eye", eye);
    set("light", light);
    set("base", base);
  }
};

struct PhongPerPixel : Lit {
  template <class R>
  struct Varyings {
    vec3<R> position, normal;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position = in.position;
    out.normal = in.normal;
    return clip_from_world * vec4<R>(in.position, R(1.0f));
  }
  static constexpr const char* kVertexGlsl = R"(
    layout(location = 0) in vec3 in_position;
    layout(location = 1) in vec3 in_normal;
    uniform mat4 clip_from_world;
    out vec3 position, normal;
    void main() {
      position = in_position;
      normal = in_normal;
      gl_Position = transform(clip_from_world, vec4(in_position, 1.0));
    })";

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    const vec2<R> lit = blinn_phong(in.position, in.normal, eye, light);
    return {vec4<R>(base * lit.x + vec3<R>(lit.y), R(1.0f))};
  }
  static constexpr const char* kFragmentGlsl = R"(
    in vec3 position, normal;
    uniform vec3 base, eye, light;
    out vec4 fragment;
    void main() {
      vec2 lit = blinn_phong(position, normal, eye, light);
      fragment = vec4(base * lit.x + vec3(lit.y), 1.0);
    })";
};

/// PhongPerPixel with a texture in place of the base color, sampled at the level of detail of OpenGL 4.6, section 8.14.1.
struct TexturedPhong : Lit {
  const Texture2D* albedo = nullptr;
  Sampler sampler;

  template <class R>
  struct Varyings {
    vec3<R> position, normal;
    vec2<R> uv;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position = in.position;
    out.normal = in.normal;
    out.uv = in.uv;
    return clip_from_world * vec4<R>(in.position, R(1.0f));
  }
  static constexpr const char* kVertexGlsl = R"(
    layout(location = 0) in vec3 in_position;
    layout(location = 1) in vec3 in_normal;
    layout(location = 2) in vec2 in_uv;
    uniform mat4 clip_from_world;
    out vec3 position, normal;
    out vec2 uv;
    void main() {
      position = in_position;
      normal = in_normal;
      uv = in_uv;
      gl_Position = transform(clip_from_world, vec4(in_position, 1.0));
    })";

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec2<R> lit = blinn_phong(in.position, in.normal, eye, light);
    const vec4<R> texel = albedo->sample(sampler, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv));
    return {vec4<R>(vec3<R>(texel) * lit.x + vec3<R>(lit.y), R(1.0f))};
  }
  static constexpr const char* kFragmentGlsl = R"(
    in vec3 position, normal;
    in vec2 uv;
    uniform sampler2D albedo;
    uniform vec3 eye, light;
    out vec4 fragment;
    void main() {
      vec2 lit = blinn_phong(position, normal, eye, light);
      vec4 texel = textureLod(albedo, uv, level_of_detail(textureSize(albedo, 0), dFdx(uv), dFdy(uv)));
      fragment = vec4(texel.rgb * lit.x + vec3(lit.y), 1.0);
    })";

  template <class Set>
  void uniforms(const Set& set) const {
    Lit::uniforms(set);
    set("albedo", *albedo, sampler);
  }
};

/// TexturedPhong, but the GLSL version lets Mesa choose the level of detail.
struct ImplicitlyTexturedPhong : TexturedPhong {
  static constexpr const char* kFragmentGlsl = R"(
    in vec3 position, normal;
    in vec2 uv;
    uniform sampler2D albedo;
    uniform vec3 eye, light;
    out vec4 fragment;
    void main() {
      vec2 lit = blinn_phong(position, normal, eye, light);
      vec4 texel = texture(albedo, uv);
      fragment = vec4(texel.rgb * lit.x + vec3(lit.y), 1.0);
    })";
};

struct Gouraud : Lit {
  template <class R>
  struct Varyings {
    vec2<R> lit;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.lit = blinn_phong(in.position, in.normal, eye, light);
    return clip_from_world * vec4<R>(in.position, R(1.0f));
  }
  static constexpr const char* kVertexGlsl = R"(
    layout(location = 0) in vec3 in_position;
    layout(location = 1) in vec3 in_normal;
    uniform mat4 clip_from_world;
    uniform vec3 eye, light;
    smooth out vec2 lit;
    void main() {
      lit = blinn_phong(in_position, in_normal, eye, light);
      gl_Position = transform(clip_from_world, vec4(in_position, 1.0));
    })";

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(base * in.lit.x + vec3<R>(in.lit.y), R(1.0f))};
  }
  static constexpr const char* kFragmentGlsl = R"(
    smooth in vec2 lit;
    uniform vec3 base;
    out vec4 fragment;
    void main() { fragment = vec4(base * lit.x + vec3(lit.y), 1.0); })";
};

struct FlatLit : Lit {
  template <class R>
  struct Varyings {
    Flat<vec2<R>> lit;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.lit.value = blinn_phong(in.position, in.normal, eye, light);
    return clip_from_world * vec4<R>(in.position, R(1.0f));
  }
  static constexpr const char* kVertexGlsl = R"(
    layout(location = 0) in vec3 in_position;
    layout(location = 1) in vec3 in_normal;
    uniform mat4 clip_from_world;
    uniform vec3 eye, light;
    flat out vec2 lit;
    void main() {
      lit = blinn_phong(in_position, in_normal, eye, light);
      gl_Position = transform(clip_from_world, vec4(in_position, 1.0));
    })";

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(base * in.lit.value.x + vec3<R>(in.lit.value.y), R(1.0f))};
  }
  static constexpr const char* kFragmentGlsl = R"(
    flat in vec2 lit;
    uniform vec3 base;
    out vec4 fragment;
    void main() { fragment = vec4(base * lit.x + vec3(lit.y), 1.0); })";
};

}  // namespace halfspace::test
