// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace {

/// Maps a texture to a horizontal plane by x and z, with up to 16x anisotropic filtering.
struct FloorShader {
  glm::mat4 clip_from_world;
  const Texture2D* texture;

  template <class R>
  struct Attributes {
    vec3<R> position_ws;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = vec2<R>(in.position_ws.x, in.position_ws.z) * 0.0625f;
    return clip_from_world * vec4<R>(in.position_ws, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {texture->sample(kSampler, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv))};
  }

 private:
  static constexpr Sampler kSampler{.anisotropy = 16};
};

}  // namespace halfspace
