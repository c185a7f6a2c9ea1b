// SPDX-License-Identifier: Apache-2.0
// A shader with EvaluatedVaryings but no geometry function, which would read them, must not compile, and
// the error must contain: a geometry function that reads them.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct NoGeometry {
  static constexpr TessellationLayout tessellation_layout{};
  template <class R>
  struct Attributes {
    vec4<R> position;
  };
  template <class R>
  struct Varyings {};
  template <class R>
  struct EvaluatedVaryings {
    R value;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return in.position;
  }
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, Varyings<R>, 3>&) const {
    return {};
  }
  template <class R>
  vec4<R> evaluate(const PatchInput<R, Varyings<R>, 3>& in, const vec3<R>& at, EvaluatedVaryings<R>&) const {
    return in.position[0] * at.x;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(1))};
  }
};

void draw(Pass& pass, const VertexView& view) { pass.draw(NoGeometry{}, view); }
