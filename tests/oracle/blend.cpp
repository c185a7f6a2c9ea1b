// SPDX-License-Identifier: Apache-2.0
#include "oracle/blend.h"

#include <cmath>

namespace halfspace::oracle {

namespace {

float blend_factor(BlendFactor f, const glm::vec4& src, const glm::vec4& src1, const glm::vec4& dst, const glm::vec4& constant, int k) {
  switch (f) {
    case BlendFactor::zero: return 0.0f;
    case BlendFactor::one: return 1.0f;
    case BlendFactor::src_color: return src[k];
    case BlendFactor::one_minus_src_color: return 1.0f - src[k];
    case BlendFactor::dst_color: return dst[k];
    case BlendFactor::one_minus_dst_color: return 1.0f - dst[k];
    case BlendFactor::src_alpha: return src.w;
    case BlendFactor::one_minus_src_alpha: return 1.0f - src.w;
    case BlendFactor::dst_alpha: return dst.w;
    case BlendFactor::one_minus_dst_alpha: return 1.0f - dst.w;
    case BlendFactor::constant_color: return constant[k];
    case BlendFactor::one_minus_constant_color: return 1.0f - constant[k];
    case BlendFactor::constant_alpha: return constant.w;
    case BlendFactor::one_minus_constant_alpha: return 1.0f - constant.w;
    case BlendFactor::src_alpha_saturate: return k == 3 ? 1.0f : src.w < 1.0f - dst.w ? src.w : 1.0f - dst.w;
    case BlendFactor::src1_color: return src1[k];
    case BlendFactor::one_minus_src1_color: return 1.0f - src1[k];
    case BlendFactor::src1_alpha: return src1.w;
    case BlendFactor::one_minus_src1_alpha: return 1.0f - src1.w;
  }
  return 0.0f;
}

float blend_channel(BlendEquation equation, float s, float s_factor, float d, float d_factor) {
  const float from_source = s * s_factor;
  switch (equation) {
    case BlendEquation::add: return std::fma(d, d_factor, from_source);
    case BlendEquation::subtract: return std::fma(-d, d_factor, from_source);
    case BlendEquation::reverse_subtract: return std::fma(d, d_factor, -from_source);
    case BlendEquation::min: return s < d ? s : d;
    case BlendEquation::max: return s > d ? s : d;
  }
  return 0.0f;
}

}  // namespace

glm::vec4 blend(const BlendState& b, const glm::vec4& src, const glm::vec4& src1, const glm::vec4& dst, const glm::vec4& constant,
                float unit, bool clamps_factors) {
  const auto factor = [&](BlendFactor f, int k) {
    const float x = blend_factor(f, src, src1, dst, constant, k);
    return !clamps_factors ? x : x > 1.0f ? 1.0f : x < -1.0f ? -1.0f : x;
  };
  glm::vec4 out;
  for (int k = 0; k < 4; ++k) {
    const bool alpha = k == 3;
    const float s = factor(alpha ? b.source_alpha : b.source_color, k);
    const float d = factor(alpha ? b.destination_alpha : b.destination_color, k);
    const float existing = unit == 1.0f ? dst[k] : std::round(dst[k] * unit);
    out[k] = blend_channel(alpha ? b.alpha_equation : b.color_equation, src[k] * unit, s, existing, d);
  }
  return out;
}

}  // namespace halfspace::oracle
