// SPDX-License-Identifier: Apache-2.0
//
// From where a light's maps are taken, and what each spans: as little as is needed, since a map's texels are given.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace halfspace {

/// A picture to be taken from a light; world space, double. Depth is reversed, clip depth in [0, w].
struct LightView {
  glm::dmat4 clip_from_world{1.0};
  double texel_per_w = 1.0;     ///< world width of a texel where clip w is 1
  double depth_per_unit = 1.0;  ///< window depth per unit along the axis where w is 1
  bool perspective = false;
  double near = 0.0, far = 1.0;  ///< units along the axis, from the light (or, directional, from the view's own start)
};

/// Smallest and largest coordinates; empty where low > high.
struct Box {
  glm::dvec3 low{1e300}, high{-1e300};
  bool empty() const { return low.x > high.x; }
  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

/// The corners of a box.
std::array<glm::dvec3, 8> corners_of(const Box& box);

/// Unit vectors of a directional light's views: columns right, up, and towards the light. They depend on the direction alone.
glm::dmat3 light_axes(const glm::dvec3& to_light_ws);

/// The eight corners of what a camera sees, near ones first; clip_from_world has reversed Z in [0, w].
std::array<glm::dvec3, 8> frustum_corners(const glm::dmat4& clip_from_world);

/// The part of a frustum between two shares of the way from its near to its far end, 0 ≤ from < to ≤ 1.
std::array<glm::dvec3, 8> frustum_slice(const std::array<glm::dvec3, 8>& frustum, double from, double to);

/// The corners of what frustum and box have in common; none where they are apart. Each corner of such a body lies on an edge
/// of the one within the other.
std::vector<glm::dvec3> common_corners(const std::array<glm::dvec3, 8>& frustum, const Box& box_ws);

/// A directional light's view that holds `receivers` (coordinates along the axes) with `margin` texels round them, and of the
/// `casters` all that may shade any point of its square, which is wider: depth reaches from the receivers' far end to the near end of the
/// casters over the square. Width and place are held to steps of the grid, so that a moving camera does not make shadows crawl: edges
/// 2^(1/4) apart, origin on whole texels.
LightView directional_view(const glm::dmat3& axes, const Box& receivers, std::span<const Box> casters, int size, double margin);

/// A view from a point along `forward`, of `angle` radians with `margin` texels round that.
LightView spot_view(const glm::dvec3& position, const glm::dvec3& forward, double angle, double near, double far, int size, double margin);

/// The six views of a point light, in the order +x −x +y −y +z −z.
std::array<LightView, 6> cube_views(const glm::dvec3& position, double near, double far, int size, double margin);

/// Where to part the distances near … far for `count` cascades: count + 1 numbers; between even and geometric steps
/// (Zhang et al., "Parallel-split shadow maps", VRCIA 2006), weight 0 … 1 towards the geometric.
std::vector<double> cascade_splits(double near, double far, int count, double weight);

}  // namespace halfspace
