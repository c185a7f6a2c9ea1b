// SPDX-License-Identifier: Apache-2.0
//
// Blend factors and equations (OpenGL 4.6, section 17.3.6). If the state is a constant, they compile to a few instructions.
#pragma once

#include "halfspace/raster/tile/tile_format.h"

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

/// Returns one channel of the blended color, before it is clamped to the range of the format. src and dst have the same unit.
HS_INLINE Real blend_sum(BlendEquation e, Real src, Real src_factor, Real dst, Real dst_factor) {
  switch (e) {
    case BlendEquation::add: return fma(dst, dst_factor, src * src_factor);
    case BlendEquation::subtract: return fma(-dst, dst_factor, src * src_factor);
    case BlendEquation::reverse_subtract: return fma(dst, dst_factor, -(src * src_factor));
    case BlendEquation::min: return min(src, dst);
    case BlendEquation::max: return max(src, dst);
  }
  return src;
}

/// The factors of a state.
struct BlendFactors {
  BlendFactor source_color, destination_color, source_alpha, destination_alpha;

  bool operator==(const BlendFactors&) const = default;
};
/// The factors and equations of a state.
struct BlendOperation {
  BlendEquation color_equation, alpha_equation;
  BlendFactors factors;

  bool operator==(const BlendOperation&) const = default;
};
/// Returns the operation of a state.
inline BlendOperation operation_of(const BlendState& s) {
  return {s.color_equation, s.alpha_equation, {s.source_color, s.destination_color, s.source_alpha, s.destination_alpha}};
}

/// An operation that is only known at run time. Its factors are found in a table, without branches.
struct AnyOperation : BlendOperation {};

/// Returns the blended color, before it is clamped. src and dst can have any unit; the colors in `from` are linear.
HS_INLINE PacketColor blend_sums(const BlendOperation& o, const PacketColor& src, const PacketColor& dst, const BlendSources& from) {
  PacketColor out;
  for (std::size_t k = 0; k < 4; ++k) {
    const Real source = blend_factor(k == 3 ? o.factors.source_alpha : o.factors.source_color, from, k);
    const Real destination = blend_factor(k == 3 ? o.factors.destination_alpha : o.factors.destination_color, from, k);
    out[k] = blend_sum(k == 3 ? o.alpha_equation : o.color_equation, src[k], source, dst[k], destination);
  }
  return out;
}

namespace detail {

/// A factor as operand · scale + offset. It has the same bits as the operand, or as 1 minus the operand.
struct FactorTerm {
  std::size_t operand;  ///< index into FactorOperands
  float scale, offset;  ///< 1 and −0, or −1 and 1
};
/// The operands of factors: three values, and the four channels of each color.
struct FactorOperands {
  static constexpr std::size_t zero = 0, one = 1, saturate = 2, src = 3, dst = 7, src1 = 11, constant = 15, count = 19;
  static constexpr std::size_t alpha = 3;  ///< of a color
  std::array<Real, count> values;
};

/// Returns factor f for channel k.
constexpr FactorTerm factor_term(BlendFactor f, std::size_t k) {
  using enum BlendFactor;
  using Operands = FactorOperands;
  constexpr std::size_t src = Operands::src, dst = Operands::dst, src1 = Operands::src1, constant = Operands::constant;
  constexpr std::size_t alpha = Operands::alpha;
  const auto plain = [](std::size_t operand) { return FactorTerm{operand, 1.0f, -0.0f}; };
  const auto complement = [](std::size_t operand) { return FactorTerm{operand, -1.0f, 1.0f}; };
  switch (f) {
    case zero: return plain(Operands::zero);
    case one: return plain(Operands::one);
    case src_color: return plain(src + k);
    case one_minus_src_color: return complement(src + k);
    case dst_color: return plain(dst + k);
    case one_minus_dst_color: return complement(dst + k);
    case src_alpha: return plain(src + alpha);
    case one_minus_src_alpha: return complement(src + alpha);
    case dst_alpha: return plain(dst + alpha);
    case one_minus_dst_alpha: return complement(dst + alpha);
    case constant_color: return plain(constant + k);
    case one_minus_constant_color: return complement(constant + k);
    case constant_alpha: return plain(constant + alpha);
    case one_minus_constant_alpha: return complement(constant + alpha);
    case src_alpha_saturate: return plain(k == alpha ? Operands::one : Operands::saturate);
    case src1_color: return plain(src1 + k);
    case one_minus_src1_color: return complement(src1 + k);
    case src1_alpha: return plain(src1 + alpha);
    case one_minus_src1_alpha: return complement(src1 + alpha);
  }
  return plain(Operands::one);
}
inline constexpr std::size_t kFactorCount = static_cast<std::size_t>(BlendFactor::one_minus_src1_alpha) + 1;
inline constexpr auto kFactorTerms = [] {
  std::array<std::array<FactorTerm, 4>, kFactorCount> terms{};
  for (std::size_t f = 0; f < kFactorCount; ++f) {
    for (std::size_t k = 0; k < 4; ++k) terms[f][k] = factor_term(static_cast<BlendFactor>(f), k);
  }
  return terms;
}();

HS_INLINE FactorOperands factor_operands(const BlendSources& s) {
  FactorOperands operands;
  operands.values[FactorOperands::zero] = Real(0.0f);
  operands.values[FactorOperands::one] = Real(1.0f);
  operands.values[FactorOperands::saturate] = min(s.src[FactorOperands::alpha], Real(1.0f) - s.dst[FactorOperands::alpha]);
  for (std::size_t k = 0; k < 4; ++k) {
    operands.values[FactorOperands::src + k] = s.src[k];
    operands.values[FactorOperands::dst + k] = s.dst[k];
    operands.values[FactorOperands::src1 + k] = s.clamped(s.src1[k]);
    operands.values[FactorOperands::constant + k] = s.clamped(Real(s.constant[static_cast<int>(k)]));
  }
  return operands;
}

}  // namespace detail

/// blend_sums() for an operation that is only known at run time. The result has the same bits.
HS_INLINE PacketColor blend_sums(const AnyOperation& o, const PacketColor& src, const PacketColor& dst, const BlendSources& from) {
  const detail::FactorOperands operands = detail::factor_operands(from);
  const auto factor = [&](BlendFactor f, std::size_t k) {
    const detail::FactorTerm& term = detail::kFactorTerms[static_cast<std::size_t>(f)][k];
    return fma(operands.values[term.operand], Real(term.scale), Real(term.offset));
  };
  PacketColor out;
  for (std::size_t k = 0; k < 4; ++k) {
    const Real source = factor(k == 3 ? o.factors.source_alpha : o.factors.source_color, k);
    const Real destination = factor(k == 3 ? o.factors.destination_alpha : o.factors.destination_color, k);
    out[k] = blend_sum(k == 3 ? o.alpha_equation : o.color_equation, src[k], source, dst[k], destination);
  }
  return out;
}

/// Returns false if the blended value of a channel with values in [0, 1] is known not to exceed 1, apart from rounding.
constexpr bool can_exceed_one(const BlendOperation& o, bool alpha) {
  using enum BlendFactor;
  const BlendFactor source = alpha ? o.factors.source_alpha : o.factors.source_color;
  const BlendFactor destination = alpha ? o.factors.destination_alpha : o.factors.destination_color;
  if ((alpha ? o.alpha_equation : o.color_equation) != BlendEquation::add) return false;
  if (source == zero || destination == zero) return false;
  if (destination == one_minus_src_alpha) return source != src_alpha && !(alpha && source == one);
  return !(destination == one_minus_constant_color && source == constant_color);
}
/// Returns true if the blended value of a channel with values in [0, 1] can be negative.
constexpr bool can_be_negative(const BlendOperation& o, bool alpha) {
  const BlendEquation e = alpha ? o.alpha_equation : o.color_equation;
  return e == BlendEquation::subtract || e == BlendEquation::reverse_subtract;
}
constexpr bool can_exceed_one(const AnyOperation&, bool) { return true; }
constexpr bool can_be_negative(const AnyOperation&, bool) { return true; }

/// Clamps the source color of a fixed-point format, which must precede blending (OpenGL 4.6, section 17.3.6).
HS_INLINE PacketColor clamped_color(PacketColor c) {
  for (Real& x : c) x = clamp(x, Real(0.0f), Real(1.0f));
  return c;
}

/// Returns the color that blending writes to a buffer that is not rgba8, before it is clamped. dst: the existing color.
template <class Operation>
HS_INLINE PacketColor blended_color(const Operation& o, const PacketColor& dst, bool fixed_point, const PacketColor& src,
                                    const PacketColor& src1, const glm::vec4& constant) {
  const PacketColor in_range = fixed_point ? clamped_color(src) : src;
  return blend_sums(o, in_range, dst, {in_range, dst, src1, constant, fixed_point});
}

/// The same for a packet of an rgba8 buffer. Returns the packed codes. first: index of the packet's first pixel.
/// Blends in units of codes: the existing codes are exact, and the sum only needs to be rounded to an integer. Before that, it differs from
/// the exact sum by at most 1e-4: 2^-24 times 255 for the source in codes, for its product with the factor, and for each factor, and 2^-24
/// times 510 for the sum.
template <class Operation>
HS_INLINE Int blended_codes(const Operation& o, const ColorBuffer& buffer, std::size_t first, const PacketColor& linear,
                            const PacketColor& src1, const glm::vec4& constant) {
  const Int codes = read_codes(buffer, first);
  const PacketColor src = clamped_color(linear);
  PacketColor src_codes, dst, dst_codes;
  for (std::size_t k = 0; k < 4; ++k) {
    src_codes[k] = src[k] * Real(255.0f);
    dst_codes[k] = to_real<Real>(code_of(codes, static_cast<int>(k)));
    dst[k] = unorm8_to_linear(dst_codes[k]);
  }
  PacketColor out = blend_sums(o, src_codes, dst_codes, {src, dst, src1, constant, true});
  for (std::size_t k = 0; k < 4; ++k) {
    if (can_exceed_one(o, k == 3)) out[k] = min(out[k], Real(255.0f));
    if (can_be_negative(o, k == 3)) out[k] = max(out[k], Real(0.0f));
  }
  return pack_rounded(out);
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
