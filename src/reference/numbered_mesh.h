// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/shading/sphere/sphere_depth.h"
#include "halfspace/shading/surface/depth_only.h"

namespace halfspace::HS_LANES {

/// Writes the number of a mesh to the red channel.
struct NumberedMesh : DepthOnly {
  float number = 0.0f;

  template <class R>
  Fragment<R> fragment(const Varyings<R>&) const {
    return {vec4<R>(R(number), R(0), R(0), R(1))};
  }
};

/// Writes the number of a set of spheres to the red channel.
struct NumberedSphere : SphereDepth {
  float number = 0.0f;

  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    DepthFragment<R> f = SphereDepth::fragment(in, px);
    f.color = vec4<R>(R(number), R(0), R(0), R(1));
    return f;
  }
};

}  // namespace halfspace::HS_LANES
