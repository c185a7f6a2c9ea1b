// SPDX-License-Identifier: Apache-2.0
//
// What a light sees: the depth of the nearest surface, on a grid of texels, and how a point of the world is found on it.
//
//   receiver (point, normal) ─ shadow_view.h: the view that holds it → place: texel, depth, slope of its plane
//                            ─ shadow_bias.h: the same place, moved so that a surface does not shade itself
//                            ─ shadow_filter.h: share of the light that arrives
//
// Depth is reversed (1 nearest to the light, 0 farthest, cleared to 0), so where nothing was drawn nothing shades.
// L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978.
#pragma once

#include <span>

#include "halfspace/core/image.h"
#include "halfspace/core/vec.h"
#include "halfspace/shading/light_types.h"

namespace halfspace {

/// The widest penumbra that pcss looks for, texels.
inline constexpr float kMaxPenumbra = 64.0f;
/// Of ShadowBias::automatic: texels (see automatic_lift), and the largest tangent of the light's angle that it follows, 89.99 degrees.
inline constexpr float kAutomaticLift = 0.5f, kSteepestSlope = 1e4f;

/// One picture taken from a light. Positions come with the world's axes and the eye as origin (_rws, see Light).
struct ShadowView {
  glm::mat4 clip_from_rws{1.0f};        ///< clip depth in [0, w], reversed
  glm::mat4 clip_plane_from_rws{1.0f};  ///< its inverse transpose: takes planes where the other takes points
  float texel_per_w = 1.0f;             ///< world width of a texel where clip w is 1; it grows with w
  float depth_per_unit = 1.0f;          ///< window depth per world unit along the view's axis where w is 1; it falls with w²
  bool perspective = false;             ///< w is the distance along the axis, in units; else w is 1
  float near = 0.0f, far = 1.0f;        ///< units along the axis from the light
  int size = 0;                         ///< texels a side
  const float* depth = nullptr;         ///< size² reversed window depths, top row first; not owned
  const glm::vec4* moments = nullptr;   ///< size² filtered powers 1 to 4 of the linear depth (0 near, 1 far); for vsm and moments
};

/// The shadows of one light: one view, up to four cascades (finest first), or the six of a point light. A point that no view
/// holds is lit.
struct Shadow {
  std::span<const ShadowView> views;  ///< not owned; empty: the light casts none
  ShadowSettings settings;
};

/// What is asked: a point on a surface. All unit vectors.
template <class R>
struct ShadowReceiver {
  vec3<R> position_rws;
  vec3<R> face_normal_ws;     ///< of the triangle, on the side of the light
  vec3<R> shading_normal_ws;  ///< as the light is computed with
  vec3<R> to_light_ws;
  R x_px, y_px;  ///< window coordinates; turn vogel's and pcss's disk
};

}  // namespace halfspace
