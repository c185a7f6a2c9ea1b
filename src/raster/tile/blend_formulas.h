// SPDX-License-Identifier: Apache-2.0
//
// Blend factors and equations (OpenGL 4.6, section 17.3.6). If the state is a constant, they compile to a few instructions.
#pragma once

#include "halfspace/raster/tile/tile.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Values that blend factors refer to. With a fixed-point attachment, src1 and constant must be clamped before use.
struct BlendSources {
  const PacketColor &src, &dst, &src1;
  const glm::vec4& constant;
  bool fixed_point;

  Real clamped(Real x) const { return fixed_point ? clamp(x, Real(0.0f), Real(1.0f)) : x; }
};

/// Returns factor f for channel k.
HS_INLINE Real blend_factor(BlendFactor f, const BlendSources& s, std::size_t k) {
  const Real one(1.0f);
  const auto constant = [&](std::size_t i) { return s.clamped(Real(s.constant[static_cast<int>(i)])); };
  switch (f) {
    case BlendFactor::zero: return Real(0.0f);
    case BlendFactor::one: return one;
    case BlendFactor::src_color: return s.src[k];
    case BlendFactor::one_minus_src_color: return one - s.src[k];
    case BlendFactor::dst_color: return s.dst[k];
    case BlendFactor::one_minus_dst_color: return one - s.dst[k];
    case BlendFactor::src_alpha: return s.src[3];
    case BlendFactor::one_minus_src_alpha: return one - s.src[3];
    case BlendFactor::dst_alpha: return s.dst[3];
    case BlendFactor::one_minus_dst_alpha: return one - s.dst[3];
    case BlendFactor::constant_color: return constant(k);
    case BlendFactor::one_minus_constant_color: return one - constant(k);
    case BlendFactor::constant_alpha: return constant(3);
    case BlendFactor::one_minus_constant_alpha: return one - constant(3);
    case BlendFactor::src_alpha_saturate: return k == 3 ? one : min(s.src[3], one - s.dst[3]);
    case BlendFactor::src1_color: return s.clamped(s.src1[k]);
    case BlendFactor::one_minus_src1_color: return one - s.clamped(s.src1[k]);
    case BlendFactor::src1_alpha: return s.clamped(s.src1[3]);
    case BlendFactor::one_minus_src1_alpha: return one - s.clamped(s.src1[3]);
  }
  return one;
}

/// Returns one channel of the blended color, before it is clamped to the range of the format.
HS_INLINE Real blend_sum(BlendEquation e, Real src, Real src_factor, Real dst, Real dst_factor) {
  switch (e) {
    case BlendEquation::add: return src * src_factor + dst * dst_factor;
    case BlendEquation::subtract: return src * src_factor - dst * dst_factor;
    case BlendEquation::reverse_subtract: return dst * dst_factor - src * src_factor;
    case BlendEquation::min: return min(src, dst);
    case BlendEquation::max: return max(src, dst);
  }
  return src;
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
