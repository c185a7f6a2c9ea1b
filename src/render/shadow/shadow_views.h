// SPDX-License-Identifier: Apache-2.0
//
// Views from which a light's shadow maps are rendered. Each view is as small as possible, because its number of texels is fixed.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

/// A view from a light, in world space and double precision. Depth is reversed, with clip depth in [0, w].
struct LightView {
  glm::dmat4 clip_from_world{1.0};
  double texel_per_w = 1.0;     ///< world width of a texel where clip w = 1
  double depth_per_unit = 1.0;  ///< window depth per unit along the axis where w = 1
  bool perspective = false;
  double near = 0.0, far = 1.0;  ///< distance along the axis from the light; for directional lights, from the start of the view
  friend bool operator==(const LightView&, const LightView&) = default;
};

/// Axis-aligned bounds; empty if low > high.
struct Box {
  glm::dvec3 low{1e300}, high{-1e300};
  bool empty() const { return low.x > high.x; }
  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

/// Returns the corners of a box. Bits 0, 1 and 2 of the index select the high x, y and z.
std::array<glm::dvec3, 8> corners_of(const Box& box);

/// Returns the axes of a directional light's views as unit vectors: right, up, and towards the light. They depend only on the
/// direction.
glm::dmat3 light_axes(const glm::dvec3& to_light_ws);

/// Returns the corners of the view frustum, near ones first. clip_from_world must have reversed Z in [0, w].
std::array<glm::dvec3, 8> frustum_corners(const glm::dmat4& clip_from_world);

/// The same for the view of a camera. Exact also if the far plane is so distant that the inverse of the matrix is not.
std::array<glm::dvec3, 8> frustum_corners(const View& view);

/// Returns the part of a frustum between two fractions of the way from the near plane to the far plane, 0 ≤ from < to ≤ 1.
std::array<glm::dvec3, 8> frustum_slice(const std::array<glm::dvec3, 8>& frustum, double from, double to);

/// Returns the vertices of the intersection of frustum and box, or an empty list if they do not intersect. Each vertex lies on an edge of
/// one body and inside the other body.
std::vector<glm::dvec3> common_corners(const std::array<glm::dvec3, 8>& frustum, const Box& box_ws);

/// Returns a square view of a directional light that contains `receivers` (in coordinates along the axes) plus `margin` texels on
/// each side. Its depth range extends from the nearest of the `casters` that overlap the square to the far end of the receivers.
/// The texel size is rounded up to a power of 2^(1/4) and the origin is snapped to whole texels, so that shadows do not shimmer
/// when the camera moves.
LightView directional_view(const glm::dmat3& axes, const Box& receivers, std::span<const Box> casters, int size, double margin);

/// Returns a view from a point along `forward`. It spans `angle` radians plus a margin of `margin` texels.
LightView spot_view(const glm::dvec3& position, const glm::dvec3& forward, double angle, double near, double far, int size, double margin);

/// Returns the six views of a point light, in the order +x −x +y −y +z −z.
std::array<LightView, 6> cube_views(const glm::dvec3& position, double near, double far, int size, double margin);

/// Splits the range of distances from near to far into `count` cascades and returns the count + 1 boundaries. They are interpolated
/// between uniform (weight 0) and geometric (weight 1) steps (Zhang et al., "Parallel-split shadow maps", VRCIA 2006).
std::vector<double> cascade_splits(double near, double far, int count, double weight);

}  // namespace halfspace::HS_LANES
