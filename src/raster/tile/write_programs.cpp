// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/write_programs.h"

#include <array>

#include "halfspace/raster/tile/blend_codes.h"

namespace halfspace::HS_LANES {

namespace {

using enum BlendFactor;
constexpr BlendOperation operation(BlendEquation equation, const BlendFactors& factors) { return {equation, equation, factors}; }
constexpr BlendOperation sum_of(const BlendFactors& factors) { return operation(BlendEquation::add, factors); }
constexpr BlendOperation kOver = sum_of({src_alpha, one_minus_src_alpha, one, one_minus_src_alpha});
constexpr BlendOperation kOverSameAlpha = sum_of({src_alpha, one_minus_src_alpha, src_alpha, one_minus_src_alpha});
constexpr BlendOperation kPremultiplied = sum_of({one, one_minus_src_alpha, one, one_minus_src_alpha});
constexpr BlendOperation kAddAlpha = sum_of({src_alpha, one, one, one});
constexpr BlendOperation kAddSameAlpha = sum_of({src_alpha, one, src_alpha, one});
constexpr BlendOperation kAdd = sum_of({one, one, one, one});
constexpr BlendOperation kMultiply = sum_of({dst_color, zero, dst_color, zero});
constexpr BlendOperation kMultiplySource = sum_of({zero, src_color, zero, src_color});
constexpr BlendOperation kMultiplyTwice = sum_of({dst_color, src_color, dst_color, src_color});
constexpr BlendOperation kScreen = sum_of({one, one_minus_src_color, one, one_minus_src_color});
constexpr BlendOperation kScreenByDestination = sum_of({one_minus_dst_color, one, one_minus_dst_color, one});
constexpr BlendOperation kUnder = sum_of({one_minus_dst_alpha, one, one_minus_dst_alpha, one});
constexpr BlendOperation kConstant = sum_of({constant_color, one_minus_constant_color, constant_color, one_minus_constant_color});
constexpr BlendOperation kDualSource = sum_of({one, src1_color, one, src1_color});
constexpr BlendOperation kDualSourceCoverage = sum_of({one, one_minus_src1_color, one, one_minus_src1_alpha});
constexpr BlendOperation kSubtractAlpha = operation(BlendEquation::reverse_subtract, {src_alpha, one, src_alpha, one});
constexpr BlendOperation kMin = operation(BlendEquation::min, {one, one, one, one});
constexpr BlendOperation kMax = operation(BlendEquation::max, {one, one, one, one});

// Writes a color to one packet. masked: the state may disable channels.
template <ColorFormat format, bool masked>
HS_INLINE void replace_packet(ColorBuffer& buffer, const PacketMask& packet, const PacketColor& color, const ColorMask& channels) {
  const std::size_t first = static_cast<std::size_t>(packet.packet) * kLanes;
  const Mask mask = mask_from_bits<Mask>(packet.lanes);
  if constexpr (is_fixed_point(format)) {
    const Int codes = packed_codes<format>(color);
    write_codes(buffer, first, mask, masked ? merged_codes(codes, read_codes(buffer, first), channels) : codes);
  } else {
    for (int k = 0; k < 4; ++k) {
      if (masked && !channels[k]) continue;
      store_halves(plane<uint16_t>(buffer, k) + first, color[static_cast<std::size_t>(k)], mask);
    }
  }
}

// Blends one packet. The compiler evaluates the switches in the formulas if the operation is a constant BlendOperation.
template <ColorFormat format, bool masked, class Operation>
HS_INLINE void blend_packet(ColorBuffer& buffer, const PacketMask& packet, const PacketColor& src, const PacketColor& src1,
                            const Operation& o, const AttachmentState& s) {
  const std::size_t first = static_cast<std::size_t>(packet.packet) * kLanes;
  if constexpr (format == ColorFormat::rgba8) {
    const Int codes = blended_codes(o, buffer, first, src, src1, s.blend->constant);
    write_codes(buffer, first, mask_from_bits<Mask>(packet.lanes), masked ? merged_codes(codes, read_codes(buffer, first), s.mask) : codes);
  } else {
    PacketColor dst;
    for (int k = 0; k < 4; ++k) dst[static_cast<std::size_t>(k)] = read_channel<format>(buffer, first, k);
    const PacketColor out = blended_color(o, dst, format, src, src1, s.blend->constant);
    replace_packet<format, masked>(buffer, packet, out, s.mask);
  }
}

template <ColorFormat format, bool masked, BlendOperation operation>
void blend(ColorBuffer& buffer, PacketMask packet, const AttachmentState& s, Real r, Real g, Real b, Real a, const PacketColor* src1) {
  const PacketColor src{r, g, b, a};
  constexpr bool is_dual = operation == kDualSource || operation == kDualSourceCoverage;
  blend_packet<format, masked>(buffer, packet, src, is_dual ? *src1 : src, operation, s);
}
// For all other blend states.
template <ColorFormat format>
void blend_by_state(ColorBuffer& buffer, PacketMask packet, const AttachmentState& s, Real r, Real g, Real b, Real a,
                    const PacketColor* src1) {
  const PacketColor src{r, g, b, a};
  blend_packet<format, true>(buffer, packet, src, src1 != nullptr ? *src1 : src, AnyOperation{operation_of(*s.blend)}, s);
}
template <ColorFormat format, bool masked>
void replace(ColorBuffer& buffer, PacketMask packet, const AttachmentState& s, Real r, Real g, Real b, Real a, const PacketColor*) {
  replace_packet<format, masked>(buffer, packet, {r, g, b, a}, s.mask);
}

// Returns the operation of a state. The factors do not matter for the minimum and the maximum.
BlendOperation compiled_operation(const BlendState& s) {
  BlendOperation o = operation_of(s);
  if (ignores_factors(o.color_equation) && ignores_factors(o.alpha_equation)) o.factors = {one, one, one, one};
  return o;
}

template <ColorFormat format, bool masked>
WriteProgram program_of(const std::optional<BlendState>& s) {
  if (!s) return replace<format, masked>;
  const BlendOperation operation = compiled_operation(*s);
  if (operation == kOver) return blend<format, masked, kOver>;
  if (operation == kOverSameAlpha) return blend<format, masked, kOverSameAlpha>;
  if (operation == kPremultiplied) return blend<format, masked, kPremultiplied>;
  if (operation == kAddAlpha) return blend<format, masked, kAddAlpha>;
  if (operation == kAddSameAlpha) return blend<format, masked, kAddSameAlpha>;
  if (operation == kAdd) return blend<format, masked, kAdd>;
  if (operation == kMultiply) return blend<format, masked, kMultiply>;
  if (operation == kMultiplySource) return blend<format, masked, kMultiplySource>;
  if (operation == kMultiplyTwice) return blend<format, masked, kMultiplyTwice>;
  if (operation == kScreen) return blend<format, masked, kScreen>;
  if (operation == kScreenByDestination) return blend<format, masked, kScreenByDestination>;
  if (operation == kUnder) return blend<format, masked, kUnder>;
  if (operation == kConstant) return blend<format, masked, kConstant>;
  if (operation == kDualSource) return blend<format, masked, kDualSource>;
  if (operation == kDualSourceCoverage) return blend<format, masked, kDualSourceCoverage>;
  if (operation == kSubtractAlpha) return blend<format, masked, kSubtractAlpha>;
  if (operation == kMin) return blend<format, masked, kMin>;
  if (operation == kMax) return blend<format, masked, kMax>;
  return blend_by_state<format>;
}

template <ColorFormat format>
WriteProgram program_of(const AttachmentState& s) {
  return s.mask.all() ? program_of<format, false>(s.blend) : program_of<format, true>(s.blend);
}

}  // namespace

WriteProgram write_program(ColorFormat format, const AttachmentState& s) {
  switch (format) {
    case ColorFormat::rgba8: return program_of<ColorFormat::rgba8>(s);
    case ColorFormat::srgb8a8: return program_of<ColorFormat::srgb8a8>(s);
    case ColorFormat::rgba16f: return program_of<ColorFormat::rgba16f>(s);
    default: return nullptr;
  }
}

}  // namespace halfspace::HS_LANES
