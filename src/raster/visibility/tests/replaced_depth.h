// SPDX-License-Identifier: Apache-2.0
//
// The depth of fragments of a shader that writes depth, and what its promise (ConservativeDepth) allows.
#pragma once

#include "halfspace/core/check.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/tile_format.h"

namespace halfspace::HS_LANES {

/// Returns true if the depth of the shader is bounded by that of the primitive; and true if a fragment fails the depth test if the depth of
/// the primitive does. A depth that is returned once for several samples is not bounded, because the primitive has another one at each.
inline bool has_depth_bound(const Draw& draw) {
  const ConservativeDepth bound = draw.kernels.conservative_depth;
  const bool has_one_depth = !draw.is_multisampled || draw.shades_samples;
  return (bound == ConservativeDepth::greater || bound == ConservativeDepth::less) && draw.kernels.writes_depth && has_one_depth;
}
inline bool rejects_by_bound(const Draw& draw) {
  const CompareOp op = draw.state.depth.compare;
  const bool is_greater = draw.kernels.conservative_depth == ConservativeDepth::greater;
  const bool matches =
      is_greater ? op == CompareOp::less || op == CompareOp::less_equal : op == CompareOp::greater || op == CompareOp::greater_equal;
  return has_depth_bound(draw) && matches;
}

/// Returns the depth of fragments of a shader that writes depth, represented as in Tile::depth. own: what the shader returned; z: depth of
/// the primitive, which is only used if it is a bound; has_bound: has_depth_bound(draw); mask: the fragments that are drawn.
HS_INLINE Real replaced_depth(const Draw& draw, DepthFormat format, Real own, Real z, bool has_bound, [[maybe_unused]] Mask mask) {
  const Real depth = depth_value(format, clamp(own, Real(draw.depth_low), Real(draw.depth_high)));
  if (!has_bound) return depth;
  const bool is_greater = draw.kernels.conservative_depth == ConservativeDepth::greater;
  // Pixel::z() can differ from z by the rounding of both. Other formats than d32f are codes.
  [[maybe_unused]] const Real rounding(format == DepthFormat::d32f ? 0x1p-22f : 1.0f);
  HS_DCHECK(!any(mask & (is_greater ? depth < z - rounding : depth > z + rounding)));
  return is_greater ? max(depth, z) : min(depth, z);
}

}  // namespace halfspace::HS_LANES
