// SPDX-License-Identifier: Apache-2.0
//
// Selection of mip levels and filters for a level of detail (OpenGL 4.6, sections 8.14 and 8.15).
#pragma once

#include "halfspace/core/lane_pairs.h"
#include "halfspace/shading/texture/sampler.h"

namespace halfspace::HS_LANES::detail {

/// The levels that a lookup reads: level `index` and, for lanes that are between levels, level index + 1 with the weight `fraction`.
template <class R>
struct LevelChoice {
  IntOf<R> index;
  R fraction;  ///< 0 … 1 − 2^-14; 0 for lanes that are not between levels
  MaskOf<R> between, nearest;
};

/// If the fractional LOD is below this, only the finer mip level is read. The result changes by less than 1/16384 of the difference between
/// the levels. A quad drawn at its native size has a level of detail of about 1e-7.
template <class R>
inline constexpr float kLevelSnap = std::is_same_v<R, double> ? 0.0f : 0x1p-14f;

/// For samplers without LodControl whose filter is nearest, bilinear or trilinear. whole must be floor(lod + kLevelSnap). If lod is out of
/// range, any level beyond that end of the mip chain will do. levels: number of levels.
template <class R>
HS_INLINE LevelChoice<R> choose_common_level(const Sampler& sampler, int levels, R lod, IntOf<R> whole) {
  const MaskOf<R> minified = lod > R(0.0f);
  const MaskOf<R> nearest = select(minified, MaskOf<R>(sampler.min == Filter::nearest), MaskOf<R>(sampler.mag == Filter::nearest));
  const int32_t last = sampler.min == Filter::trilinear ? levels - 1 : 0;
  const IntOf<R> index = min(max(whole, IntOf<R>(0)), IntOf<R>(last));
  const R fraction = lod - to_real<R>(index);
  const MaskOf<R> between = fraction > R(kLevelSnap<R>) && index < IntOf<R>(last);
  return {index, select(between, fraction, R(0.0f)), between, nearest};
}
/// The same for any level of detail. NaN means level 0. max_levels: at least the number of levels.
template <class R>
HS_INLINE LevelChoice<R> choose_common_level(const Sampler& sampler, int levels, int max_levels, R lod) {
  const R whole = floor(clamp(lod, R(0.0f), R(static_cast<float>(max_levels))) + R(kLevelSnap<R>));
  return choose_common_level(sampler, levels, lod, truncate_to_int(whole));
}

/// Returns whether a sampler needs choose_level.
inline bool has_special_levels(const Sampler& sampler) { return sampler.min > Filter::trilinear || !(sampler.lod == LodControl{}); }

/// Returns a level of detail after the bias. NaN means 0 before.
template <class R>
HS_INLINE R biased_lod(const LodControl& control, R lod) {
  return select(lod == lod, lod, R(0.0f)) + R(control.bias);
}
/// The same after bias and limits.
template <class R>
HS_INLINE R controlled_lod(const LodControl& control, R lod) {
  return clamp(biased_lod(control, lod), control.min, control.max);
}

/// Returns the level next to a level of detail of at least 0, the finer one if it is between two: ceil(lod + 1/2) − 1, at least 0.
template <class R>
HS_INLINE R nearest_level(R lod) {
  return max(-floor(-(lod + R(0.5f))) - R(1.0f), R(0.0f));
}

/// Chooses levels for any sampler. lod is before bias and limits.
template <class R>
HS_INLINE LevelChoice<R> choose_level(const Sampler& sampler, int levels, int max_levels, R lod) {
  if (!has_special_levels(sampler)) return choose_common_level(sampler, levels, max_levels, lod);
  const R controlled = controlled_lod(sampler.lod, lod);
  if (sampler.min == Filter::trilinear || sampler.min <= Filter::bilinear)
    return choose_common_level(sampler, levels, max_levels, controlled);
  // Section 8.15: a minified texture must not appear sharper than a magnified one.
  const bool later = reads_nearest_texel(sampler.min) && !reads_nearest_texel(sampler.mag);
  const MaskOf<R> minified = controlled > R(later ? 0.5f : 0.0f);
  const MaskOf<R> nearest = select(minified, MaskOf<R>(reads_nearest_texel(sampler.min)), MaskOf<R>(reads_nearest_texel(sampler.mag)));
  const R limited = select(minified, clamp(controlled, 0.0f, R(static_cast<float>(levels - 1))), R(0.0f));
  if (sampler.min == Filter::nearest_mipmap_linear) {
    const R whole = floor(limited + R(kLevelSnap<R>)), fraction = limited - whole;
    const MaskOf<R> between = fraction > R(kLevelSnap<R>);
    return {truncate_to_int(whole), select(between, fraction, R(0.0f)), between, nearest};
  }
  return {truncate_to_int(nearest_level(limited)), R(0.0f), MaskOf<R>(false), nearest};
}

}  // namespace halfspace::HS_LANES::detail
