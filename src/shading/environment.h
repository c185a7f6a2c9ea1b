// SPDX-License-Identifier: Apache-2.0
//
// Light from far away by its direction: a panorama (equirectangular) or the six faces of a cube.
//
// Map space (ms) is left-handed: x to the right, y up, z ahead, as seen from within by whoever took the picture. That is the
// space of OpenGL's cube maps (OpenGL 4.6, section 8.13, table 8.19).
//   panorama  u = 1/2 + atan2(x, z)/2π, v = angle from +y over π: the middle shows +z, the left and right edge −z
//   cube      faces +x −x +y −y +z −z (right, left, top, bottom, front, back), row 0 on top, as OpenGL has them
//
// Nothing jumps. Each level of a panorama has a row more beyond either pole: the row beside the pole, half a turn on; u
// wraps. Each level of a face has a border of its neighbours' texels; at a cube's corner, where three faces meet, the
// fourth texel is the mean of the three. So both faces mix the same four texels on their common edge.
//
// The level of detail comes from the derivatives of the direction. A panorama's is the angle that a pixel spans, over that of
// a texel beside the equator: it knows of no seam and no pole. (GL's rule, by the derivative of u, goes to infinity there.)
// Texels crowd round the poles, so the smaller levels are averaged along each row over W/(2H sin) texels at that angle from
// the pole: a texel's own width on the sphere. Level 0 is as given. A cube's level is GL's.
#pragma once

#include <array>
#include <vector>

#include "halfspace/shading/texture.h"

namespace halfspace {

enum class EnvironmentLayout : uint8_t { panorama, cube };

/// Right-handed world space (x right, y up, −z ahead) into map space.
inline const glm::mat3 kMapFromWorld{1, 0, 0, 0, 1, 0, 0, 0, -1};
/// The world round the map of a globe, seen from the globe's middle: u and v as uv_sphere has them. East lies to the left.
inline const glm::mat3 kMapFromGlobe{0, 0, -1, 0, 1, 0, 1, 0, 0};

/// An immutable environment. It owns its texels; any number of threads may read it at once.
class EnvironmentMap {
 public:
  /// A panorama: all of 2π wide and π high, whatever its proportion. Texel is u8vec4 (format srgb8a8) or vec4 (linear;
  /// rgba16f or rgba32f). Alpha is not used. At least 1 × 1.
  template <class Texel>
  EnvironmentMap(const Image<Texel>& panorama, TexelFormat format);
  /// Six square faces of one size, in the order of the header.
  template <class Texel>
  EnvironmentMap(const std::array<Image<Texel>, 6>& faces, TexelFormat format);

  EnvironmentLayout layout() const { return layout_; }
  TexelFormat format() const { return images_.front().format(); }
  int levels() const { return levels_; }
  /// Of one face, or the panorama.
  int width(int level = 0) const { return image(level, 0).width() - (layout_ == EnvironmentLayout::cube ? 2 : 0); }
  int height(int level = 0) const { return image(level, 0).height() - 2; }

  /// The filtered linear light from direction d_ms (any length but 0), for a pixel whose steps to the right and up change it
  /// by dx_ms and dy_ms. Trilinear. Any bits are allowed: where the direction is 0 or not finite the result is some
  /// texel's.
  template <Number R>
  vec3<R> sample(const vec3<R>& d_ms, const vec3<R>& dx_ms, const vec3<R>& dy_ms) const;

  /// The level of detail that sample takes, before it is held to the levels that there are.
  template <Number R>
  R level_of_detail(const vec3<R>& d_ms, const vec3<R>& dx_ms, const vec3<R>& dy_ms) const;

 private:
  // Where a direction falls: which image of a level, coordinates in [0, 1], and the level.
  template <class R>
  struct Coordinates {
    IntOf<R> face;
    vec2<R> st;
    R lod;
  };

  template <class R>
  Coordinates<R> place(const vec3<R>& d, const vec3<R>& dx, const vec3<R>& dy) const;
  template <class R>
  Coordinates<R> place_on_panorama(const vec3<R>& d, const vec3<R>& dx, const vec3<R>& dy) const;
  template <class R>
  Coordinates<R> cube_coordinates(const vec3<R>& d, const vec3<R>& dx, const vec3<R>& dy) const;
  template <class R>
  vec4<R> fetch(const Coordinates<R>& at, IntOf<R> level) const;

  int faces() const { return layout_ == EnvironmentLayout::cube ? 6 : 1; }
  const Texture2D& image(int level, int face) const { return images_[static_cast<std::size_t>(level * faces() + face)]; }

  EnvironmentLayout layout_;
  int levels_ = 0;
  std::vector<Texture2D> images_;  // with borders, of one level each; level by level, face by face
};

/// An environment in its place.
struct Environment {
  const EnvironmentMap* map = nullptr;
  glm::mat3 map_from_world = kMapFromWorld;
  float brightness = 1.0f;

  /// Light from direction d_ws; see EnvironmentMap::sample.
  template <class R>
  vec3<R> light(const vec3<R>& d_ws, const vec3<R>& dx_ws, const vec3<R>& dy_ws) const {
    return map->sample<R>(map_from_world * d_ws, map_from_world * dx_ws, map_from_world * dy_ws) * R(brightness);
  }
};

/// Two environments, one fading into the other. Only those that are seen are looked up.
struct EnvironmentBlend {
  Environment first, second;  ///< where weight is 0 or 1, the map that is not seen may be null
  float weight = 0.0f;        ///< of the second, 0 to 1

  template <class R>
  vec3<R> light(const vec3<R>& d_ws, const vec3<R>& dx_ws, const vec3<R>& dy_ws) const {
    if (weight <= 0.0f) return first.light(d_ws, dx_ws, dy_ws);
    const vec3<R> there = second.light(d_ws, dx_ws, dy_ws);
    if (weight >= 1.0f) return there;
    return first.light(d_ws, dx_ws, dy_ws) * R(1.0f - weight) + there * R(weight);
  }
};

}  // namespace halfspace
