// SPDX-License-Identifier: Apache-2.0
//
// Shadow maps: a grid with the depth of the surface closest to a light, and the data that is needed to look up a point in it.
//
//   receiver (point, normal) ─ shadow_view.h: position in the view that contains it: texel, depth, slope of its plane
//                            ─ shadow_bias.h: the same position, moved so that a surface does not shadow itself
//                            ─ shadow_filter.h: fraction of the light that reaches it
//
// Depth is reversed: 1 is closest to the light, 0 farthest. Maps are cleared to 0, so empty texels cast no shadow.
// L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978.
#pragma once

#include <span>

#include "halfspace/core/image.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"
#include "halfspace/shading/values/light_types.h"

namespace halfspace::HS_LANES {

/// Maximum penumbra radius of pcss, in texels.
inline constexpr float kMaxPenumbra = 64.0f;
/// For ShadowBias::automatic: offset in texels (see automatic_depth_offset), and the maximum tangent of the angle of incidence (89.99
/// degrees).
inline constexpr float kAutomaticDepthOffset = 0.5f, kSteepestSlope = 1e4f;

/// One depth image as seen from a light. Positions are in camera-relative world space (_rws, see Light).
struct ShadowView {
  glm::mat4 clip_from_rws{1.0f};        ///< clip depth in [0, w], reversed
  glm::mat4 clip_plane_from_rws{1.0f};  ///< inverse transpose of clip_from_rws; transforms planes
  float texel_per_w = 1.0f;             ///< width of a texel in world units where clip w is 1; proportional to w
  float depth_per_unit = 1.0f;          ///< window depth per world unit along the axis where w is 1; falls off with w²
  bool perspective = false;             ///< true: w is the distance along the axis in world units; false: w is 1
  float near = 0.0f, far = 1.0f;        ///< distances along the axis from the light, in world units
  int size = 0;                         ///< texels per side
  const float* depth = nullptr;         ///< size² reversed window depths, top row first; not owned
  /// For each block of 8x8 texels, bottom row first, the largest depth in it and in the blocks to its right, above it, and above to the
  /// right; see shadow_blocks.h. Not owned. null: none, which changes only the speed.
  const float* block_depths = nullptr;
  const glm::vec4* moments = nullptr;  ///< size² filtered powers 1 to 4 of the linear depth (0 near, 1 far); used by vsm and moments
};

/// The shadow of one light: a single view, up to four cascades (finest first), or the six views of a point light. Points outside
/// all views are lit.
struct Shadow {
  std::span<const ShadowView> views;  ///< not owned; if empty, the light casts no shadow
  ShadowSettings settings;
};

/// The surface point that is tested for shadow. All vectors are unit vectors unless stated otherwise.
template <class R>
struct ShadowReceiver {
  vec3<R> position_rws;
  vec3<R> face_normal_ws;     ///< normal of the triangle, on the side of the eye
  vec3<R> shading_normal_ws;  ///< the normal that is used for lighting
  vec3<R> to_light_ws;
  R x_px, y_px;  ///< window coordinates; they determine the rotation of the disks of vogel and pcss
  /// The shading normal without the detail of a normal map: interpolated from the vertices. Zero: the same as shading_normal_ws.
  vec3<R> smooth_normal_ws{R(0)};
  R smooth_height{0};  ///< height of the smooth surface above the triangle (shading/shadow/terminator.h), in world units
};

/// Returns the smooth normal, or the shading normal if there is none.
template <class R>
HS_INLINE vec3<R> smooth_normal(const ShadowReceiver<R>& at) {
  return select(dot(at.smooth_normal_ws, at.smooth_normal_ws) > R(0), at.smooth_normal_ws, at.shading_normal_ws);
}

}  // namespace halfspace::HS_LANES
