// SPDX-License-Identifier: Apache-2.0
//
// Blending of rgba8 buffers, in units of codes: the existing codes are exact, and the result only needs to be rounded to an integer.
#pragma once

#include "halfspace/core/lane_bytes.h"
#include "halfspace/raster/tile/blend_formulas.h"

namespace halfspace::HS_LANES {

/// Returns true if the operation does not scale the existing color: it adds a term to it, subtracts a term from it, or selects one of two
/// colors. Then only the other term has to be rounded, and both are combined as bytes.
constexpr bool combines_codes(const BlendOperation& o) {
  using enum BlendEquation;
  if (o.color_equation != o.alpha_equation) return false;
  switch (o.color_equation) {
    case add:
    case reverse_subtract: return o.factors.destination_color == BlendFactor::one && o.factors.destination_alpha == BlendFactor::one;
    case min:
    case max: return true;
    case subtract: break;
  }
  return false;
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

namespace detail {

/// For operations with combines_codes(). Before it is rounded, the term differs from the exact one by at most 1e-4: 2^-24 times 255 for
/// each rounding of the factor and for its product with 255. The product with the source is only rounded to an integer.
template <class Operation>
HS_INLINE Int combined_codes(const Operation& o, Int codes, const BlendSources& from) {
  const auto factors = factors_of(o, from);
  PacketColor term;
  for (std::size_t k = 0; k < 4; ++k) {
    const Real factor = ignores_factors(o.color_equation) ? Real(1.0f) : factors.source(k);
    term[k] = fma(from.src[k], factor * Real(255.0f), Real(kRoundingBias));
  }
  const Int rounded = pack_biased(term);
  switch (o.color_equation) {
    case BlendEquation::min: return min_bytes(codes, rounded);
    case BlendEquation::max: return max_bytes(codes, rounded);
    case BlendEquation::reverse_subtract: return subtract_bytes(codes, rounded);
    case BlendEquation::add: return add_bytes(codes, rounded);
    case BlendEquation::subtract: break;  // never combines codes
  }
  return codes;
}

/// For all other operations. Before it is rounded, the sum differs from the exact one by at most 1e-4: 2^-24 times 255 for the source in
/// codes, for its product with the factor, and for each factor, and 2^-24 times 510 for the sum.
template <class Operation>
HS_INLINE Int summed_codes(const Operation& o, const PacketColor& dst_codes, const BlendSources& from) {
  PacketColor src_codes;
  for (std::size_t k = 0; k < 4; ++k) src_codes[k] = from.src[k] * Real(255.0f);
  PacketColor out = blend_sums(o, src_codes, dst_codes, from);
  for (std::size_t k = 0; k < 4; ++k) {
    if (can_exceed_one(o, k == 3)) out[k] = min(out[k], Real(255.0f));
    if (can_be_negative(o, k == 3)) out[k] = max(out[k], Real(0.0f));
  }
  return pack_rounded(out);
}

}  // namespace detail

/// Returns the packed codes that blending writes to a packet of an rgba8 buffer. first: index of the packet's first pixel.
template <class Operation>
HS_INLINE Int blended_codes(const Operation& o, const ColorBuffer& buffer, std::size_t first, const PacketColor& linear,
                            const PacketColor& src1, const glm::vec4& constant) {
  const Int codes = read_codes(buffer, first);
  const PacketColor src = clamped_color(linear, ColorFormat::rgba8);
  PacketColor dst, dst_codes;
  for (std::size_t k = 0; k < 4; ++k) {
    dst_codes[k] = to_real<Real>(code_of(codes, static_cast<int>(k)));
    dst[k] = unorm8_to_linear(dst_codes[k]);
  }
  const BlendSources from{src, dst, src1, constant, ColorFormat::rgba8};
  return combines_codes(o) ? detail::combined_codes(o, codes, from) : detail::summed_codes(o, dst_codes, from);
}

}  // namespace halfspace::HS_LANES
