// SPDX-License-Identifier: Apache-2.0
//
// Small shaders that several test programs use. Positions are in clip space unless the shader has a matrix.
#pragma once

#include "halfspace/raster/pass.h"

namespace halfspace {

template <class R>
struct PositionAttributes {
  vec4<R> position;
};
template <class R>
struct ColoredAttributes {
  vec4<R> position;
  vec4<R> color;
};
template <class R>
struct NoVaryings {};

/// Only a position; for depth-only draws.
struct PositionShader {
  template <class R>
  using Attributes = PositionAttributes<R>;
  template <class R>
  using Varyings = NoVaryings<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return in.position;
  }
};

/// Only a position, transformed with a matrix.
struct MatrixShader {
  glm::mat4 clip_from_model{1.0f};
  template <class R>
  using Attributes = PositionAttributes<R>;
  template <class R>
  using Varyings = NoVaryings<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return clip_from_model * in.position;
  }
};

/// The same integers everywhere. Colors: ivec4 or uvec4.
template <template <class> class Colors>
struct ConstantIntegers : PositionShader {
  glm::ivec4 values{0};
  ConstantIntegers(const glm::ivec4& v) : values(v) {}
  template <class R>
  TypedFragment<R, Colors<R>> fragment(const NoVaryings<R>&, const Pixel<R>&) const {
    return {Colors<R>(ivec4<R>(IntOf<R>(values.x), IntOf<R>(values.y), IntOf<R>(values.z), IntOf<R>(values.w)))};
  }
};

/// A single color for all pixels.
struct ConstantShader : PositionShader {
  glm::vec4 color{1.0f};
  ConstantShader() = default;
  ConstantShader(const glm::vec4& c) : color(c) {}
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(color.x), R(color.y), R(color.z), R(color.w))};
  }
};

/// The color of the provoking vertex.
struct FlatColorShader {
  template <class R>
  using Attributes = ColoredAttributes<R>;
  template <class R>
  struct Varyings {
    Flat<vec4<R>> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color.value = in.color;
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color.value};
  }
};

/// The colors of the vertices with perspective-correct interpolation.
struct SmoothColorShader {
  template <class R>
  using Attributes = ColoredAttributes<R>;
  template <class R>
  struct Varyings {
    vec4<R> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color};
  }
};

/// The colors of the vertices, interpolated linearly in the window.
struct LinearColorShader {
  template <class R>
  using Attributes = ColoredAttributes<R>;
  template <class R>
  struct Varyings {
    NoPerspective<vec4<R>> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color.value = in.color;
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color.value};
  }
};

}  // namespace halfspace
