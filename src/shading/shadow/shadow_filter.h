// SPDX-License-Identifier: Apache-2.0
//
// Shadow map filters: the fraction of a light that reaches a point, from depth comparisons and averaging.
#pragma once

#include <array>

#include "halfspace/shading/shadow/shadow_blocks.h"
#include "halfspace/shading/shadow/shadow_moments.h"
#include "halfspace/shading/shadow/shadow_view.h"

namespace halfspace::HS_LANES {

namespace detail {

/// Returns N points spread evenly over the unit disk: r = sqrt((i + 1/2)/N), each rotated by the golden angle relative to the
/// previous one. H. Vogel, "A better way to construct the sunflower head", Mathematical Biosciences 44 (1979).
template <int N>
const std::array<glm::vec2, N>& vogel_disk() {
  static const std::array<glm::vec2, N> points = [] {
    std::array<glm::vec2, N> p;
    for (int i = 0; i < N; ++i) {
      const SinCos<float> angle = sin_cos(2.39996323f * static_cast<float>(i));
      p[static_cast<std::size_t>(i)] = sqrt((static_cast<float>(i) + 0.5f) / N) * glm::vec2(angle.cos, angle.sin);
    }
    return p;
  }();
  return points;
}

/// Returns a fraction of a turn that differs between neighboring pixels: interleaved gradient noise (Jimenez, SIGGRAPH course 2014).
template <class R>
HS_INLINE R pixel_turn(R x_px, R y_px) {
  const R a = x_px * R(0.06711056f) + y_px * R(0.00583715f);
  const R b = R(52.9829189f) * (a - floor(a));
  return b - floor(b);
}

template <class R>
struct Turn {
  R cos, sin;
  HS_INLINE vec2<R> operator()(const glm::vec2& p) const { return {cos * p.x - sin * p.y, sin * p.x + cos * p.y}; }
};
template <class R>
HS_INLINE Turn<R> turn_of(const ShadowReceiver<R>& at) {
  const SinCos<R> a = sin_cos(pixel_turn(at.x_px, at.y_px) * R(6.28318531f));
  return {a.cos, a.sin};
}

}  // namespace detail

/// Compares with the texel that contains the point.
template <class R>
HS_INLINE R hard_shadow(const ShadowView& view, const ShadowCoordinates<R>& p) {
  return lit_by_texel(view, p, truncate_to_int(floor(p.x)), truncate_to_int(floor(p.y)));
}

/// Returns what box_pcf returns if all texels are lit, with the same rounding.
template <int width, class R>
HS_INLINE R box_of_lit_texels(R fx, R fy) {
  R row(0), sum(0);
  for (int i = 0; i <= width; ++i) row = fma(i == 0 ? R(1) - fx : i == width ? fx : R(1), R(1), row);
  for (int j = 0; j <= width; ++j) sum = fma(j == 0 ? R(1) - fy : j == width ? fy : R(1), row, sum);
  return sum * R(1.0f / (width * width));
}

/// Returns the mean over a square of width x width texels centered at the point. Texels that the square covers partially are weighted
/// by their covered area. width must be odd; 1 is bilinear comparison.
template <int width, class R>
HS_INLINE R box_pcf(const ShadowView& view, const ShadowCoordinates<R>& p) {
  const R left = p.x - R(0.5f * width), low = p.y - R(0.5f * width);
  const R left_texel = floor(left), low_texel = floor(low);
  const R fx = left - left_texel, fy = low - low_texel;
  const IntOf<R> i0 = truncate_to_int(left_texel), j0 = truncate_to_int(low_texel);
  if constexpr (width >= 5) {
    static_assert(width < kShadowBlock);
    if (view.block_depths != nullptr && all(is_lit_by_blocks(view, p, i0, j0, 0.5f * width + 0.5f)))
      return box_of_lit_texels<width>(fx, fy);
  }
  constexpr int at_once = width % 4 == 3 ? 4 : 2;
  R sum(0);
  for (int j = 0; j <= width; ++j) {
    R row(0);
    for (int i = 0; i <= width; i += at_once) {
      const std::array<R, at_once> lit = lit_by_texels<at_once>(view, p, IntOf<R>(i0 + i), IntOf<R>(j0 + j));
      for (int n = 0; n < at_once; ++n)
        row = fma(i + n == 0 ? R(1) - fx : i + n == width ? fx : R(1), lit[static_cast<std::size_t>(n)], row);
    }
    sum = fma(j == 0 ? R(1) - fy : j == width ? fy : R(1), row, sum);
  }
  return sum * R(1.0f / (width * width));
}

/// Returns the unweighted mean of nine texels: the simple form of pcf3.
template <class R>
HS_INLINE R pcf_3x3(const ShadowView& view, const ShadowCoordinates<R>& p) {
  const IntOf<R> i = truncate_to_int(floor(p.x)), j = truncate_to_int(floor(p.y));
  R sum(0);
  for (int dj = -1; dj <= 1; ++dj) {
    for (const R& lit : lit_by_texels<3>(view, p, IntOf<R>(i - 1), IntOf<R>(j + dj))) sum += lit;
  }
  return sum * R(1.0f / 9.0f);
}

/// Returns the mean of N texels on a disk with a radius of `radius` texels.
template <int N, class R>
HS_INLINE R disk_shadow(const ShadowView& view, const ShadowCoordinates<R>& p, R radius, const detail::Turn<R>& turn) {
  R sum(0);
  for (const glm::vec2& point : detail::vogel_disk<N>()) {
    const vec2<R> d = turn(point) * radius;
    sum += lit_by_texel(view, p, truncate_to_int(floor(p.x + d.x)), truncate_to_int(floor(p.y + d.y)));
  }
  return sum * R(1.0f / N);
}

/// Returns the radius in texels of the penumbra that an occluder at the given depth casts on the point, by similar triangles.
/// Directional lights: tan · Δz, with Δz = Δdepth / depth_per_unit. Perspective views: radius · (1/w_occluder − 1/w) on the plane
/// w = 1. Since depth is depth_per_unit/w + constant, both give the same formula.
template <class R>
HS_INLINE R penumbra_texels(const ShadowView& view, float light_radius, const ShadowCoordinates<R>& p, R occluder_depth) {
  return (occluder_depth - p.depth) * R(light_radius / (view.depth_per_unit * view.texel_per_w));
}

/// Returns the visible fraction of an area light. As in percentage-closer soft shadows, a blocker search determines the maximum
/// width of the penumbra. Then each texel within that width is projected back from the point onto the light. It occludes the light
/// if it is inside the cone of the light at the depth of the texel. The closer it is to the point, the larger the area that it
/// occludes (Guennebaud, Barthe and Paulin, "Real-time soft shadow mapping by backprojection", EGSR 2006). Texels that overlap as seen
/// from the point are counted separately.
template <class R>
HS_INLINE R soft_shadow(const ShadowView& view, const ShadowCoordinates<R>& p, float light_radius, const detail::Turn<R>& turn) {
  constexpr int kSearched = 64, kProjected = 128;
  constexpr float kMinimum = 0.5f;  // in texels; below this radius a single texel occludes the whole light
  // A texel at offset d: blocks is 1 if it is closer to the light than the point, and cone is the radius of the light's cone at its depth.
  struct Tap {
    R blocks, cone;
  };
  const auto tap_at = [&](const vec2<R>& d) {
    const IntOf<R> i = truncate_to_int(floor(p.x + d.x)), j = truncate_to_int(floor(p.y + d.y));
    return Tap{R(1) - lit_by_texel(view, p, i, j), max(penumbra_texels(view, light_radius, p, map_depth<R>(view, i, j)), R(kMinimum))};
  };
  const R searched = clamp(penumbra_texels(view, light_radius, p, R(1)), R(kMinimum), R(kMaxPenumbra));
  R widest(0);
  for (const glm::vec2& point : detail::vogel_disk<kSearched>()) {
    const Tap tap = tap_at(turn(point) * searched);
    widest = max(widest, tap.blocks * tap.cone);
  }
  widest = min(widest, searched);
  if (none(widest > R(0))) return R(1);
  R hidden(0);
  for (const glm::vec2& point : detail::vogel_disk<kProjected>()) {
    const vec2<R> d = turn(point) * widest;
    const Tap tap = tap_at(d);
    const R cone2 = tap.cone * tap.cone;
    hidden += tap.blocks * select(dot(d, d) <= cone2, widest * widest / cone2, R(0));
  }
  return max(R(1) - hidden * R(1.0f / kProjected), R(0));
}

/// Returns the fraction of light at a point, using the filter of the settings.
template <class R>
HS_INLINE R filtered_shadow(const ShadowView& view, const ShadowSettings& s, const ShadowCoordinates<R>& p, const ShadowReceiver<R>& at) {
  switch (s.filter) {
    case ShadowFilter::hard: return hard_shadow(view, p);
    case ShadowFilter::bilinear: return box_pcf<1>(view, p);
    case ShadowFilter::pcf3: return s.bias == ShadowBias::original ? pcf_3x3(view, p) : box_pcf<3>(view, p);
    case ShadowFilter::pcf5: return box_pcf<5>(view, p);
    case ShadowFilter::pcf7: return box_pcf<7>(view, p);
    case ShadowFilter::vogel: return disk_shadow<16>(view, p, R(s.radius), detail::turn_of(at));
    case ShadowFilter::pcss: return soft_shadow(view, p, s.light_radius, detail::turn_of(at));
    case ShadowFilter::vsm: return chebyshev_shadow(view, p);
    case ShadowFilter::moments: return four_moment_shadow(view, p);
  }
  return R(1);
}

}  // namespace halfspace::HS_LANES
