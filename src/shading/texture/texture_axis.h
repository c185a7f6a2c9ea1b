// SPDX-License-Identifier: Apache-2.0
//
// Wrap modes: from a texture coordinate to the texels along one axis, and their weights (OpenGL 4.6, section 8.14.2).
#pragma once

#include "halfspace/core/lane_pairs.h"
#include "halfspace/shading/texture/sampler.h"
#include "halfspace/shading/texture/texel_filter.h"

namespace halfspace::HS_LANES::detail {

/// Reduces a coordinate to [0, 2), the period of Wrap::mirrored, for both signs: |coordinate| mod 2, exact for every float.
template <class R>
HS_INLINE R mirror_phase(R coordinate) {
  const R a = abs(coordinate);
  return a - R(2.0f) * floor(a * R(0.5f));
}
/// Mirrors the phase at 1: the result is the distance to the nearest even number. NaN and infinities become 0.
template <class R>
HS_INLINE R mirrored_at(R phase) {
  return clamp(min(phase, R(2.0f) - phase), R(0.0f), R(1.0f));
}

/// Wraps a coordinate to [0, 1], so that all later computations are in range. NaN becomes 0. Not for Wrap::border and mirrored_clamp.
template <class R>
HS_INLINE R wrapped(R coordinate, Wrap wrap) {
  if (wrap == Wrap::repeat) return max(coordinate - floor(coordinate), R(0.0f));
  if (wrap == Wrap::mirrored) return mirrored_at(mirror_phase(coordinate));
  return clamp(coordinate, R(0.0f), R(1.0f));
}

/// Position of a lookup along one axis: between texel i (−1 … size − 1) and the next one, whose weight is fraction.
template <class R>
struct Axis {
  IntOf<R> i;
  R fraction;
  IntOf<R> steps;  ///< fraction · 2^kFractionBits; unused if R is double
};

/// Converts a coordinate to a position between texel centers, which are at i + 1/2. scale: texels per unit of the coordinate.
template <class R>
HS_INLINE Axis<R> axis(R coordinate, R scale) {
  if constexpr (std::is_same_v<R, double>) {
    const double u = coordinate * scale - 0.5;
    return {truncate_to_int(floor(u)), u - floor(u), 0};
  } else {
    constexpr int kBits = kFractionBits;
    const IntOf<R> u = round_to_int(fma(coordinate * R(1 << kBits), scale, R(-(1 << kBits) / 2)));
    const IntOf<R> steps = u & ((1 << kBits) - 1);
    return {u >> kBits, to_real<R>(steps) * R(1.0f / (1 << kBits)), steps};
  }
}

/// An axis of a level.
struct TexelAxis {
  int size;     ///< texels
  float scale;  ///< texels per unit of the coordinate: the size, or 1 for rectangle textures
  Wrap wrap;
};

/// A coordinate after wrapping: inside the image, or at most one image beyond it if the axis wraps to the border.
template <class R>
struct WrappedCoordinate {
  R at;
  MaskOf<R> mirrored;  ///< runs opposite to the image
};

template <class R>
HS_INLINE WrappedCoordinate<R> wrap_coordinate(R coordinate, const TexelAxis& axis) {
  if (axis.wrap == Wrap::mirrored) {
    // Reversed at the edges, where texel −1 is texel 0 and texel n is texel n − 1, as with clamp.
    const R phase = mirror_phase(coordinate);
    const MaskOf<R> back = phase > R(1.0f);
    return {mirrored_at(phase), select(coordinate < R(0.0f), !back, back)};
  }
  const float whole = static_cast<float>(axis.size) / axis.scale;
  if (axis.wrap == Wrap::mirrored_clamp) return {clamp(abs(coordinate), 0.0f, R(whole)), coordinate < R(0.0f)};
  if (axis.wrap == Wrap::border) return {clamp(coordinate, R(-whole), R(2.0f * whole)), MaskOf<R>(false)};
  if (axis.wrap == Wrap::clamp) return {clamp(coordinate, 0.0f, R(whole)), MaskOf<R>(false)};
  return {wrapped(coordinate, axis.wrap), MaskOf<R>(false)};
}

/// The two texels along one axis that a lookup blends.
template <class R>
struct AxisTaps {
  IntOf<R> first, second;  ///< valid indices
  R fraction;              ///< weight of the second
  MaskOf<R> first_inside, second_inside;
};

template <class R>
HS_INLINE MaskOf<R> is_inside(IntOf<R> i, int size) {
  return i >= 0 && i < IntOf<R>(size);
}
template <class R>
HS_INLINE IntOf<R> clamped_index(IntOf<R> i, int size) {
  return min(max(i, IntOf<R>(0)), IntOf<R>(size - 1));
}

/// Returns the texel that contains a coordinate. It may be outside the image if the axis wraps to the border.
template <class R>
HS_INLINE IntOf<R> texel_at(const WrappedCoordinate<R>& coordinate, const TexelAxis& axis) {
  const R position = coordinate.at * R(axis.scale);
  R i = floor(position);
  i = select(coordinate.mirrored && i == position, i - R(1.0f), i);  // at a boundary: the texel farther from 0 before mirroring
  const IntOf<R> texel = truncate_to_int(i);
  return axis.wrap == Wrap::border ? texel : min(texel, IntOf<R>(axis.size - 1));
}

/// Returns the texels on both sides of a coordinate, not yet wrapped: −1 … size − 1 and the next one. Lanes of `nearest` get the texel that
/// contains the coordinate, with a fraction of 0.
template <class R>
HS_INLINE Axis<R> between_texels(const WrappedCoordinate<R>& coordinate, const TexelAxis& of, MaskOf<R> nearest) {
  Axis<R> a = axis<R>(coordinate.at, R(of.scale));
  if (any(nearest)) {
    a.i = select(nearest, texel_at(coordinate, of), a.i);
    a.fraction = select(nearest, R(0.0f), a.fraction);
  }
  return a;
}

/// Returns the texels that a lookup along an axis blends.
template <class R>
HS_INLINE AxisTaps<R> taps(const WrappedCoordinate<R>& coordinate, const TexelAxis& of, MaskOf<R> nearest) {
  const Axis<R> a = between_texels(coordinate, of, nearest);
  const IntOf<R> next = a.i + 1;
  const MaskOf<R> first_inside = is_inside<R>(a.i, of.size), second_inside = is_inside<R>(next, of.size);
  if (of.wrap == Wrap::repeat)
    return {select(first_inside, a.i, IntOf<R>(of.size - 1)), select(second_inside, next, IntOf<R>(0)), a.fraction, true, true};
  const MaskOf<R> no_border(of.wrap != Wrap::border);
  return {clamped_index<R>(a.i, of.size), clamped_index<R>(next, of.size), a.fraction, first_inside || no_border,
          second_inside || no_border};
}

}  // namespace halfspace::HS_LANES::detail
