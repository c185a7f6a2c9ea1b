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
    const PacketColor out = blended_color(o, dst, is_fixed_point(format), src, src1, s.blend->constant);
    replace_packet<format, masked>(buffer, packet, out, s.mask);
  }
}

template <ColorFormat format, bool masked, BlendOperation operation>
void blend_batch(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                 const AttachmentState& s) {
  for (std::size_t i = 0; i < packets.size(); ++i) blend_packet<format, masked>(buffer, packets[i], src[i], src1[i], operation, s);
}
template <ColorFormat format, bool masked, BlendOperation operation>
void blend_one(ColorBuffer& buffer, PacketMask packet, const AttachmentState& s, Real r, Real g, Real b, Real a) {
  const PacketColor src{r, g, b, a};
  blend_packet<format, masked>(buffer, packet, src, src, operation, s);
}

// For all other blend states.
template <ColorFormat format>
void blend_batch_by_state(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                          const AttachmentState& s) {
  const AnyOperation o{operation_of(*s.blend)};
  for (std::size_t i = 0; i < packets.size(); ++i) blend_packet<format, true>(buffer, packets[i], src[i], src1[i], o, s);
}
template <ColorFormat format>
void blend_one_by_state(ColorBuffer& buffer, PacketMask packet, const AttachmentState& s, Real r, Real g, Real b, Real a) {
  const PacketColor src{r, g, b, a};
  blend_packet<format, true>(buffer, packet, src, src, AnyOperation{operation_of(*s.blend)}, s);
}

template <ColorFormat format, bool masked>
void replace_batch(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor*,
                   const AttachmentState& s) {
  for (std::size_t i = 0; i < packets.size(); ++i) replace_packet<format, masked>(buffer, packets[i], src[i], s.mask);
}
template <ColorFormat format, bool masked>
void replace_one(ColorBuffer& buffer, PacketMask packet, const AttachmentState& s, Real r, Real g, Real b, Real a) {
  replace_packet<format, masked>(buffer, packet, {r, g, b, a}, s.mask);
}

template <ColorFormat format>
constexpr WritePrograms kByState{blend_batch_by_state<format>, blend_one_by_state<format>};
template <ColorFormat format, bool masked, BlendOperation operation>
constexpr WritePrograms kCompiled{blend_batch<format, masked, operation>, blend_one<format, masked, operation>};
template <ColorFormat format, bool masked>
constexpr WritePrograms kReplace{replace_batch<format, masked>, replace_one<format, masked>};

// Returns the operation of a state. The factors do not matter for the minimum and the maximum.
BlendOperation compiled_operation(const BlendState& s) {
  BlendOperation o = operation_of(s);
  const auto ignores_factors = [](BlendEquation e) { return e == BlendEquation::min || e == BlendEquation::max; };
  if (ignores_factors(o.color_equation) && ignores_factors(o.alpha_equation)) o.factors = {one, one, one, one};
  return o;
}

template <ColorFormat format, bool masked>
WritePrograms programs_of(const std::optional<BlendState>& s) {
  if (!s) return kReplace<format, masked>;
  const BlendOperation operation = compiled_operation(*s);
  if (operation == kOver) return kCompiled<format, masked, kOver>;
  if (operation == kOverSameAlpha) return kCompiled<format, masked, kOverSameAlpha>;
  if (operation == kPremultiplied) return kCompiled<format, masked, kPremultiplied>;
  if (operation == kAddAlpha) return kCompiled<format, masked, kAddAlpha>;
  if (operation == kAddSameAlpha) return kCompiled<format, masked, kAddSameAlpha>;
  if (operation == kAdd) return kCompiled<format, masked, kAdd>;
  if (operation == kMultiply) return kCompiled<format, masked, kMultiply>;
  if (operation == kMultiplySource) return kCompiled<format, masked, kMultiplySource>;
  if (operation == kMultiplyTwice) return kCompiled<format, masked, kMultiplyTwice>;
  if (operation == kScreen) return kCompiled<format, masked, kScreen>;
  if (operation == kScreenByDestination) return kCompiled<format, masked, kScreenByDestination>;
  if (operation == kUnder) return kCompiled<format, masked, kUnder>;
  if (operation == kConstant) return kCompiled<format, masked, kConstant>;
  if (operation == kDualSource) return kCompiled<format, masked, kDualSource>;
  if (operation == kDualSourceCoverage) return kCompiled<format, masked, kDualSourceCoverage>;
  if (operation == kSubtractAlpha) return kCompiled<format, masked, kSubtractAlpha>;
  if (operation == kMin) return kCompiled<format, masked, kMin>;
  if (operation == kMax) return kCompiled<format, masked, kMax>;
  return kByState<format>;
}

template <ColorFormat format>
WritePrograms programs_of(const AttachmentState& s) {
  return s.mask.all() ? programs_of<format, false>(s.blend) : programs_of<format, true>(s.blend);
}

}  // namespace

WritePrograms write_programs(ColorFormat format, const AttachmentState& s) {
  switch (format) {
    case ColorFormat::rgba8: return programs_of<ColorFormat::rgba8>(s);
    case ColorFormat::srgb8a8: return programs_of<ColorFormat::srgb8a8>(s);
    case ColorFormat::rgba16f: return programs_of<ColorFormat::rgba16f>(s);
    default: return {};
  }
}

}  // namespace halfspace::HS_LANES
