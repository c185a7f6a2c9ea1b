// SPDX-License-Identifier: Apache-2.0
//
// Distant light as a function of direction: an equirectangular panorama or the six faces of a cube map.
//
// Map space (suffix _ms) is left-handed, with x right, y up and z forward, as seen from inside the map. It is the space of OpenGL cube maps
// (OpenGL 4.6, section 8.13, table 8.19).
//   panorama  u = 1/2 + atan2(x, z)/2π, v = angle from +y divided by π; the center shows +z, and the left and right edges show −z
//   cube      faces +x −x +y −y +z −z (right, left, top, bottom, front, back), row 0 at the top, as in OpenGL
//
// Filtering is seamless. Each level of a panorama has an additional row beyond either pole: the row next to the pole, rotated by
// half a turn. u wraps around. Each level of a cube face has a border of texels of its neighbors, so that both faces filter the
// same four texels at a common edge. At a cube corner, where only three faces meet, the fourth texel is the mean of the three.
//
// The level of detail is computed from the derivatives of the direction. For a panorama it is the angle that a pixel spans relative to the
// angle of a texel at the equator, and therefore has no discontinuity at the seam or the poles. (OpenGL's rule uses the derivative of u,
// which goes to infinity there.) Texels are crowded near the poles. All levels but level 0 are therefore averaged along each row, over
// W/(2H·sin θ) texels at the angle θ from the pole, which is the height of a texel on the sphere. For a cube map the level of detail is
// OpenGL's.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "halfspace/shading/texture/cube_faces.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::HS_LANES {

enum class EnvironmentLayout : uint8_t { panorama, cube };

/// Converts right-handed world space (x right, y up, −z forward) to map space.
inline const glm::mat3 kMapFromWorld{1, 0, 0, 0, 1, 0, 0, 0, -1};
/// Converts world space to the map space of a globe seen from its center, with the same u and v as on uv_sphere. East is on the left.
inline const glm::mat3 kMapFromGlobe{0, 0, -1, 0, 1, 0, 1, 0, 0};

/// An immutable environment map. It owns its texels. Any number of threads may read it concurrently.
class EnvironmentMap {
 public:
  /// Creates a panorama, which always spans 2π by π radians, regardless of its aspect ratio. Texel is u8vec4 (format srgb8a8) or
  /// vec4 (linear; rgba16f or rgba32f). Alpha is ignored. The image must have at least 1 x 1 texels.
  template <class Texel>
  EnvironmentMap(const Image<Texel>& panorama, TexelFormat format);
  /// Creates a cube map from six square faces of equal size, in the order given at the top of this file. If workers are given they share
  /// the work; the result is bit-identical.
  template <class Texel>
  EnvironmentMap(const std::array<Image<Texel>, 6>& faces, TexelFormat format, const Workers* workers = nullptr);

  /// Creates a cube map from one or more given levels. The faces of each level are half the size of those of the previous level, but at
  /// least 1 texel. Texels are linear; format is rgba16f or rgba32f.
  EnvironmentMap(std::span<const std::array<Image<glm::vec4>, 6>> levels, TexelFormat format, const Workers* workers = nullptr);

  EnvironmentLayout layout() const { return layout_; }
  TexelFormat format() const { return images_.front().format(); }
  int levels() const { return levels_; }
  /// Size of the panorama or of one face, without borders.
  int width(int level = 0) const { return image(level, 0).width() - (layout_ == EnvironmentLayout::cube ? 2 : 0); }
  int height(int level = 0) const { return image(level, 0).height() - 2; }

  /// Returns whether the light from all directions is the same.
  bool is_uniform() const;

  /// Returns the trilinearly filtered linear light from direction d_ms, which may have any length except 0. dx_ms and dy_ms are the changes
  /// in the direction to the next pixel to the right and to the next pixel up. All inputs are safe: if the direction is 0 or not finite,
  /// the result is the light from an arbitrary direction.
  template <Number R>
  vec3<R> sample(const vec3<R>& d_ms, const vec3<R>& dx_ms, const vec3<R>& dy_ms) const;

  /// Like sample, with a given level of detail. Level 0 is the finest; the level of detail is clamped to the existing levels.
  template <Number R>
  vec3<R> sample_level(const vec3<R>& d_ms, std::type_identity_t<R> lod) const;

  /// Returns the level of detail that sample uses, before it is clamped to the existing levels.
  template <Number R>
  R level_of_detail(const vec3<R>& d_ms, const vec3<R>& dx_ms, const vec3<R>& dy_ms) const;

 private:
  // The result of mapping a direction: the image within a level, coordinates in [0, 1], and the level of detail.
  template <class R>
  using Coordinates = detail::CubeCoordinates<R>;

  template <class Texel>
  void add_levels(std::span<const std::array<Image<Texel>, 6>> levels, TexelFormat format, const Workers* workers);

  template <class R>
  Coordinates<R> coordinates(const vec3<R>& d, const vec3<R>& dx, const vec3<R>& dy) const;
  template <class R>
  Coordinates<R> panorama_coordinates(const vec3<R>& d, const vec3<R>& dx, const vec3<R>& dy) const;
  template <class R>
  vec4<R> fetch(const Coordinates<R>& at, IntOf<R> level) const;
  template <class R>
  vec3<R> fetch_between_levels(const Coordinates<R>& at) const;

  int faces() const { return layout_ == EnvironmentLayout::cube ? 6 : 1; }
  const Texture2D& image(int level, int face) const { return images_[static_cast<std::size_t>(level * faces() + face)]; }

  EnvironmentLayout layout_;
  int levels_ = 0;
  std::vector<Texture2D> images_;  // one texture per level and face, with borders; all faces of a level are consecutive
};

/// An environment map with its orientation and brightness.
struct Environment {
  const EnvironmentMap* map = nullptr;
  glm::mat3 map_from_world = kMapFromWorld;
  float brightness = 1.0f;

  /// Returns the light from direction d_ws; see EnvironmentMap::sample.
  template <class R>
  vec3<R> light(const vec3<R>& d_ws, const vec3<R>& dx_ws, const vec3<R>& dy_ws) const {
    return map->sample<R>(map_from_world * d_ws, map_from_world * dx_ws, map_from_world * dy_ws) * R(brightness);
  }
};

/// A blend of two environments. An environment with weight 0 is not sampled.
struct EnvironmentBlend {
  Environment first, second;  ///< the map of an environment with weight 0 may be null
  float weight = 0.0f;        ///< weight of the second, 0 to 1

  template <class R>
  vec3<R> light(const vec3<R>& d_ws, const vec3<R>& dx_ws, const vec3<R>& dy_ws) const {
    if (weight <= 0.0f) return first.light(d_ws, dx_ws, dy_ws);
    const vec3<R> there = second.light(d_ws, dx_ws, dy_ws);
    if (weight >= 1.0f) return there;
    return first.light(d_ws, dx_ws, dy_ws) * R(1.0f - weight) + there * R(weight);
  }
};

}  // namespace halfspace::HS_LANES
