// SPDX-License-Identifier: Apache-2.0
//
// Shaders of the matrix. peers/gl/gl_matrix_glsl.h has the same formulas in GLSL.
#pragma once

#include "halfspace/shading/contract.h"
#include "matrix/matrix_scene.h"
#include "workloads/workload_shading.h"
#include "workloads/workload_tone.h"

namespace halfspace {

/// Base class of shaders for lit, textured surfaces.
struct MatrixUniforms {
  glm::mat4 clip_from_world;
  std::array<const Texture2D*, 8> maps;
  Sampler sampler;
  float threshold;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec3<R> normal;
    vec2<R> uv;
  };
  template <class R>
  HS_INLINE vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.normal = in.normal;
    out.uv = in.uv;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  HS_INLINE R diffuse(const vec3<R>& normal) const {
    return R(0.2f) + R(0.8f) * max(dot(unit(normal), vec3<R>(kMatrixLight)), R(0));
  }
  template <class R>
  HS_INLINE vec4<R> texel(const Varyings<R>& in, const Pixel<R>& px) const {
    return maps[0]->sample(sampler, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv));
  }
  /// Returns the texture's color after lighting, with the texture's alpha.
  template <class R>
  HS_INLINE vec4<R> lit_texel(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec4<R> color = texel(in, px);
    return vec4<R>(vec3<R>(color) * diffuse(in.normal), color.w);
  }
};

/// A lit surface with N textures.
template <int N>
struct MatrixLit : MatrixUniforms {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    vec3<R> sum(R(0), R(0), R(0));
    for (int i = 0; i < N; ++i) {
      const R scale(1.0f + kMatrixRepeat * static_cast<float>(i));
      sum += maps[static_cast<std::size_t>(i)]->sample_rgb(sampler, in.uv * scale, px.ddx(&Varyings<R>::uv) * scale,
                                                           px.ddy(&Varyings<R>::uv) * scale);
    }
    return {vec4<R>(sum * (diffuse(in.normal) * R(1.0f / N)), R(1))};
  }
};

/// A lit surface whose instances are small copies in a grid.
struct MatrixInstanced : MatrixLit<1> {
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.normal = in.normal;
    out.uv = in.uv;
    const auto column = static_cast<float>(id.instance % kMatrixColumns), row = static_cast<float>(id.instance / kMatrixColumns);
    const glm::vec3 offset(0.3f * (column - 0.5f * (kMatrixColumns - 1)), 0.34f * (row - 0.5f * (kMatrixRows - 1)), 0.0f);
    return clip_from_world * vec4<R>(in.position * kMatrixScale + offset, R(1));
  }
};

struct MatrixAlpha : MatrixUniforms {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {lit_texel(in, px)};
  }
};

struct MatrixDual : MatrixUniforms {
  template <class R>
  FragmentMRT<R, 2> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec4<R> color = lit_texel(in, px);
    return {{color, vec4<R>(R(1) - color.x, R(1) - color.y, R(1) - color.z, color.w)}};
  }
};

struct MatrixHoles : MatrixUniforms {
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec4<R> color = lit_texel(in, px);
    return {vec4<R>(vec3<R>(color), R(1)), color.w >= R(threshold)};
  }
};
struct MatrixHolesVisible : MatrixHoles {
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    return {maps[0]->sample_alpha(sampler, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv)) >= R(threshold), px.z()};
  }
};

/// Moves the depth toward the eye, in waves along u.
struct MatrixDepth : MatrixUniforms {
  template <class R>
  HS_INLINE R depth_at(const Varyings<R>& in, const Pixel<R>& px) const {
    const R u = in.uv.x * R(8), fraction = u - floor(u);
    return px.z() - R(0.002f) * fraction * (R(1) - fraction);
  }
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(vec3<R>(lit_texel(in, px)), R(1)), MaskOf<R>(true), depth_at(in, px)};
  }
};
struct MatrixDepthVisible : MatrixDepth {
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    return {MaskOf<R>(true), depth_at(in, px)};
  }
};

/// Base class of the shaders of full-screen passes.
struct MatrixPass : MatrixUniforms {
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv;
    return vec4<R>(in.position, R(1));
  }
};
struct MatrixPassColor : MatrixPass {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.uv.x, in.uv.y, R(0.5f), R(1))};
  }
};
struct MatrixTint : MatrixPass {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.uv.x, in.uv.y, R(0.5f), R(0.5f))};
  }
};
struct MatrixPassTexture : MatrixPass {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(maps[0]->sample_rgb(sampler, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv)), R(1))};
  }
};
struct MatrixPassTone : MatrixPass {
  WorkloadTone tone{};

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {tone(maps[0]->sample(sampler, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv)))};
  }
};

}  // namespace halfspace
