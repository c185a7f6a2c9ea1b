// SPDX-License-Identifier: Apache-2.0
//
// Blend factors and equations (OpenGL 4.6, section 17.3.6). If the state is a constant, they compile to a few instructions.
#pragma once

#include "halfspace/raster/tile/tile_format.h"

namespace halfspace::HS_LANES {

/// Clamps a channel to the range of a fixed-point format (OpenGL 4.6, section 17.3.6). Channels of other formats are returned unchanged.
HS_INLINE Real clamped_channel(Real x, ColorFormat format) {
  return is_fixed_point(format) ? clamp(x, Real(lowest_value(format)), Real(1.0f)) : x;
}

/// Values that blend factors refer to. With a fixed-point attachment, src1, constant and factors must be clamped before use.
struct BlendSources {
  const PacketColor &src, &dst, &src1;
  const glm::vec4& constant;
  ColorFormat format;

  Real clamped(Real x) const { return clamped_channel(x, format); }
  /// Returns true if 1 − x can leave the range of the format.
  bool clamps_complements() const { return lowest_value(format) < 0.0f; }
  Real complement(Real x) const { return clamps_complements() ? clamped(Real(1.0f) - x) : Real(1.0f) - x; }
};

/// Returns factor f for channel k.
HS_INLINE Real blend_factor(BlendFactor f, const BlendSources& s, std::size_t k) {
  const Real one(1.0f);
  const auto constant = [&](std::size_t i) { return s.clamped(Real(s.constant[static_cast<int>(i)])); };
  switch (f) {
    case BlendFactor::zero: return Real(0.0f);
    case BlendFactor::one: return one;
    case BlendFactor::src_color: return s.src[k];
    case BlendFactor::one_minus_src_color: return s.complement(s.src[k]);
    case BlendFactor::dst_color: return s.dst[k];
    case BlendFactor::one_minus_dst_color: return s.complement(s.dst[k]);
    case BlendFactor::src_alpha: return s.src[3];
    case BlendFactor::one_minus_src_alpha: return s.complement(s.src[3]);
    case BlendFactor::dst_alpha: return s.dst[3];
    case BlendFactor::one_minus_dst_alpha: return s.complement(s.dst[3]);
    case BlendFactor::constant_color: return constant(k);
    case BlendFactor::one_minus_constant_color: return s.complement(constant(k));
    case BlendFactor::constant_alpha: return constant(3);
    case BlendFactor::one_minus_constant_alpha: return s.complement(constant(3));
    case BlendFactor::src_alpha_saturate: return k == 3 ? one : min(s.src[3], one - s.dst[3]);
    case BlendFactor::src1_color: return s.clamped(s.src1[k]);
    case BlendFactor::one_minus_src1_color: return s.complement(s.clamped(s.src1[k]));
    case BlendFactor::src1_alpha: return s.clamped(s.src1[3]);
    case BlendFactor::one_minus_src1_alpha: return s.complement(s.clamped(s.src1[3]));
  }
  return one;
}

/// Returns true if the factors do not matter (OpenGL 4.6, section 17.3.6.1).
constexpr bool ignores_factors(BlendEquation e) { return e == BlendEquation::min || e == BlendEquation::max; }

/// Returns one channel of the blended color, before it is clamped to the range of the format. src and dst have the same unit: 0 to 1 or,
/// for rgba8, codes from 0 to 255. Factors are linear. An equation must be homogeneous: scaling src
/// and dst scales the result.
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

/// The factors of an operation for the colors of a packet. k: channel. Finds each factor by a switch, which the compiler removes if the
/// operation is a constant.
class PacketFactors {
 public:
  PacketFactors(const BlendOperation& o, const BlendSources& from) : factors_(o.factors), from_(from) {}
  HS_INLINE Real source(std::size_t k) const { return blend_factor(k == 3 ? factors_.source_alpha : factors_.source_color, from_, k); }
  HS_INLINE Real destination(std::size_t k) const {
    return blend_factor(k == 3 ? factors_.destination_alpha : factors_.destination_color, from_, k);
  }

 private:
  const BlendFactors& factors_;
  const BlendSources& from_;
};

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

/// PacketFactors for an operation that is only known at run time. The factors have the same bits.
class AnyPacketFactors {
 public:
  AnyPacketFactors(const AnyOperation& o, const BlendSources& from)
      : factors_(o.factors), from_(from), operands_(detail::factor_operands(from)) {}
  HS_INLINE Real source(std::size_t k) const { return factor(k == 3 ? factors_.source_alpha : factors_.source_color, k); }
  HS_INLINE Real destination(std::size_t k) const { return factor(k == 3 ? factors_.destination_alpha : factors_.destination_color, k); }

 private:
  HS_INLINE Real factor(BlendFactor f, std::size_t k) const {
    const detail::FactorTerm& term = detail::kFactorTerms[static_cast<std::size_t>(f)][k];
    const Real value = fma(operands_.values[term.operand], Real(term.scale), Real(term.offset));
    return from_.clamps_complements() ? from_.clamped(value) : value;
  }

  const BlendFactors& factors_;
  const BlendSources& from_;
  detail::FactorOperands operands_;
};

HS_INLINE PacketFactors factors_of(const BlendOperation& o, const BlendSources& from) { return {o, from}; }
HS_INLINE AnyPacketFactors factors_of(const AnyOperation& o, const BlendSources& from) { return {o, from}; }

/// Returns the blended color, before it is clamped. src and dst can have any unit; the colors in `from` are linear.
template <class Operation>
HS_INLINE PacketColor blend_sums(const Operation& o, const PacketColor& src, const PacketColor& dst, const BlendSources& from) {
  const auto factors = factors_of(o, from);
  PacketColor out;
  for (std::size_t k = 0; k < 4; ++k)
    out[k] = blend_sum(k == 3 ? o.alpha_equation : o.color_equation, src[k], factors.source(k), dst[k], factors.destination(k));
  return out;
}

/// Clamps a color to the range of a fixed-point format, which must precede blending.
HS_INLINE PacketColor clamped_color(PacketColor c, ColorFormat format) {
  for (Real& x : c) x = clamped_channel(x, format);
  return c;
}

/// Returns the color that blending writes to a buffer that is not rgba8, before it is clamped. dst: the existing color.
template <class Operation>
HS_INLINE PacketColor blended_color(const Operation& o, const PacketColor& dst, ColorFormat format, const PacketColor& src,
                                    const PacketColor& src1, const glm::vec4& constant) {
  const PacketColor in_range = clamped_color(src, format);
  return blend_sums(o, in_range, dst, {in_range, dst, src1, constant, format});
}

}  // namespace halfspace::HS_LANES
