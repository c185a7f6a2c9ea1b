// SPDX-License-Identifier: Apache-2.0
//
// The shader for the normals of a mesh. Its geometry function receives triangles and emits a line from each corner along the normal.
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/geometry_stage.h"

namespace halfspace::HS_LANES {

struct NormalLines {
  static constexpr GeometryLayout geometry_layout{.output = GeometryOutputPrimitive::line_strip, .max_vertices = 6};

  glm::mat4 clip_from_object, clip_from_world;
  glm::mat3 normal_from_object;  ///< normal_matrix() in geometry/camera.h
  float length;                  ///< in world space
  glm::vec4 color{1.0f};         ///< linear; multiplies the color of the normal

  template <class R>
  struct Attributes {
    vec3<R> position_os;
    vec3<R> normal_os;
  };
  template <class R>
  struct Varyings {
    vec3<R> normal_ws;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.normal_ws = normalize_or_zero(normal_from_object * in.normal_os);
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }
  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    for (std::size_t i = 0; i < 3; ++i) {
      out.emit(in.position[i], in.varyings[i]);
      out.emit(in.position[i] + clip_from_world * vec4<R>(in.varyings[i].normal_ws * R(length), R(0)), in.varyings[i]);
      out.end_primitive();
    }
  }
  /// The light is the normal: its components from −1 to 1 are red, green and blue from 0 to 1.
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>((in.normal_ws * R(0.5f) + vec3<R>(R(0.5f))) * glm::vec3(color), R(color.w))};
  }
};

}  // namespace halfspace::HS_LANES
