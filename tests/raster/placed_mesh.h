// SPDX-License-Identifier: Apache-2.0
//
// A mesh that is placed by one or two matrices, for tests of clusters.
#pragma once

#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/raster/clusters.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test {

/// Places a mesh: clip space is clip_from_world · world_from_object · position.
struct Placement {
  glm::mat4 clip_from_world, world_from_object;
  Placement(const glm::mat4& clip, const glm::mat4& world = glm::mat4(1.0f)) : clip_from_world(clip), world_from_object(world) {}
};

/// Draws the position in object space and the depth.
struct PlacedShader {
  Placement place;

  template <class R>
  struct Attributes {
    vec3<R> position;
  };
  template <class R>
  struct Varyings {
    vec3<R> position;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position = in.position;
    return place.clip_from_world * (place.world_from_object * vec4<R>(in.position, R(1.0f)));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(in.position, px.z())};
  }
};

/// A camera for pictures of 160 x 120 pixels.
inline glm::dmat4 perspective(double near = 0.1, double far = 100.0) {
  return perspective_gl(std::numbers::pi / 4, 160.0 / 120.0, near, far);
}

}  // namespace halfspace::raster_test
