// SPDX-License-Identifier: Apache-2.0
//
// A background of stars, drawn as one triangle that covers the target behind everything else.
//
// The sky is a cube with 64 x 64 cells per face. A hash of the cell determines whether it contains a star, and the position,
// brightness and tint of the star. Stars do not touch the border of their cell, so a pixel has to evaluate only one cell. A star
// is never smaller than a pixel, so stars do not flicker when the camera rotates.
#pragma once

#include <array>

#include "halfspace/core/hash.h"
#include "halfspace/shading/contract.h"

namespace halfspace::HS_LANES {

struct StarSky {
  glm::vec3 forward_ws{0, 0, -1};  ///< unit vector
  glm::vec3 right_ws{1, 0, 0};     ///< unit vector times the tangent of half the horizontal field of view
  glm::vec3 up_ws{0, 1, 0};        ///< unit vector times the tangent of half the vertical field of view
  glm::vec3 color{0.0f};           ///< linear background color
  float brightness = 1.0f;         ///< linear, for the brightest stars
  float density = 0.3f;            ///< fraction of cells that contain a star, 0 to 1
  float pixel = 1e-3f;             ///< angle in radians that a pixel covers at the image center

  template <class R>
  struct Attributes {
    vec2<R> corner;  ///< NDC
  };
  template <class R>
  struct Varyings {
    vec3<R> ray_ws;
  };

  /// Corners of the triangle, which covers the whole target.
  static constexpr std::array<glm::vec2, 3> kCorners{{{-1, -1}, {3, -1}, {-1, 3}}};

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.ray_ws = forward_ws + right_ws * in.corner.x + up_ws * in.corner.y;
    return vec4<R>(in.corner, R(0), R(1));  // reversed Z: 0 is the far plane
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(color + star_light(normalize(in.ray_ws)), R(1))};
  }

  /// Returns the light of the star in direction d (a unit vector), or 0 if there is none.
  template <class R>
  vec3<R> star_light(const vec3<R>& d) const {
    constexpr float kCells = 64.0f;
    constexpr float kCell = 2.0f / kCells;
    // The largest component determines the face; a and b are the coordinates on it.
    const MaskOf<R> is_x = abs(d.x) >= abs(d.y) && abs(d.x) >= abs(d.z);
    const MaskOf<R> is_y = !is_x && abs(d.y) >= abs(d.z);
    const R major = select(is_x, d.x, select(is_y, d.y, d.z));
    const R size = abs(major);
    const R a = select(is_x, d.y, d.x) / size, b = select(is_x || is_y, d.z, d.y) / size;
    const IntOf<R> i = truncate_to_int(clamp((a + R(1)) * R(kCells / 2), R(0), R(kCells - 1)));
    const IntOf<R> j = truncate_to_int(clamp((b + R(1)) * R(kCells / 2), R(0), R(kCells - 1)));
    const IntOf<R> axis = select(is_x, IntOf<R>(0), select(is_y, IntOf<R>(1), IntOf<R>(2)));
    const IntOf<R> face = axis * 2 + select(major < R(0), IntOf<R>(1), IntOf<R>(0));
    const IntOf<R> seed = mix_bits(IntOf<R>((face * 64 + i) * 64 + j));
    const IntOf<R> seed2 = mix_bits(IntOf<R>(seed ^ 0x51ed270b)), seed3 = mix_bits(IntOf<R>(seed2 ^ 0x2545f491));

    const MaskOf<R> present = unit_fraction<R>(seed) < R(density);
    // The center is at least 0.3 cells from the border, and the disk stays inside the cell.
    const R ca = (to_real<R>(i) + R(0.3f) + R(0.4f) * unit_fraction<R>(seed2)) * R(kCell) - R(1);
    const R cb = (to_real<R>(j) + R(0.3f) + R(0.4f) * unit_fraction<R>(seed3)) * R(kCell) - R(1);
    const R da = a - ca, db = b - cb;
    const R radius(std::min(std::max(1.3f * pixel, 0.0008f), 0.25f * kCell));
    // Away from the center of the face, a step on the face is longer than the angle by a factor of about 1/size. The factor is used for
    // both directions.
    const R off = (da * da + db * db) * (size * size) / (radius * radius);
    const R disc = max(R(1) - off, R(0));
    // The eighth power makes bright stars rare.
    const R u = unit_fraction<R>(mix_bits(IntOf<R>(seed3 ^ 0x1b56c4e9)));
    const R u2 = u * u, u4 = u2 * u2;
    const R light = select(present, disc * disc * (R(0.02f) + R(0.98f) * u4 * u4) * R(brightness), R(0));
    const R warm = unit_fraction<R>(mix_bits(IntOf<R>(seed2 ^ 0x68e31da4)));
    return vec3<R>(light * (R(0.75f) + R(0.25f) * warm), light * R(0.88f), light * (R(1) - R(0.3f) * warm));
  }
};

}  // namespace halfspace::HS_LANES
