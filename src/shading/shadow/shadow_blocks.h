// SPDX-License-Identifier: Apache-2.0
//
// Bounds of the depths in a shadow map. Where nothing in the neighborhood of a point is closer to the light than the point, a filter need
// not read the texels.
#pragma once

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/shading/shadow/shadow_view.h"

namespace halfspace::HS_LANES {

/// Texels per side of a block.
inline constexpr int kShadowBlock = 8;

inline int shadow_blocks_per_side(int size) { return (size + kShadowBlock - 1) / kShadowBlock; }

/// Returns the values of ShadowView::block_depths for a depth map, which must be square.
Image<float> shadow_block_depths(const Image<float>& depth, const Workers& workers);

/// Returns whether all texels from (i, j) to (i + 7, j + 7) whose centers are within `reach` texels of p in x and y leave the point lit.
/// May return false although they do. The view must have block_depths. Any i and j are allowed, also those of NaN positions, but the result
/// has no meaning where `holds` is false.
template <class R>
HS_INLINE MaskOf<R> is_lit_by_blocks(const ShadowView& view, const ShadowCoordinates<R>& p, IntOf<R> i, IntOf<R> j, float reach) {
  const int side = shadow_blocks_per_side(view.size);
  const auto block = [&](IntOf<R> texel) { return min(max(texel, IntOf<R>(0)) >> 3, IntOf<R>(side - 1)); };
  static_assert(kShadowBlock == 1 << 3);
  const R nearest(gather(view.block_depths, IntOf<R>(block(j) * IntOf<R>(side) + block(i))));
  // The depth that lit() compares is at least `lowest`. Its two additions round by at most 2^-24 of the sum of the magnitudes each.
  const R change = R(reach) * (abs(p.depth_dx) + abs(p.depth_dy));
  const R lowest = p.depth - change - R(0x1p-21f) * (abs(p.depth) + change);
  return max(lowest, R(0)) >= nearest;
}

}  // namespace halfspace::HS_LANES
