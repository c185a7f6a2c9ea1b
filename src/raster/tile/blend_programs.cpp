// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/blend_programs.h"

#include <array>

#include "halfspace/raster/tile/blend_formulas.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

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
constexpr BlendOperation kConstant = sum_of({constant_color, one_minus_constant_color, constant_color, one_minus_constant_color});
constexpr BlendOperation kDualSource = sum_of({one, src1_color, one, src1_color});
constexpr BlendOperation kDualSourceCoverage = sum_of({one, one_minus_src1_color, one, one_minus_src1_alpha});
constexpr BlendOperation kSubtractAlpha = operation(BlendEquation::reverse_subtract, {src_alpha, one, src_alpha, one});
constexpr BlendOperation kMin = operation(BlendEquation::min, {one, one, one, one});
constexpr BlendOperation kMax = operation(BlendEquation::max, {one, one, one, one});

// Blends one packet. The compiler evaluates the switches in the formulas if the operation is a constant.
template <ColorFormat format>
HS_INLINE void blend_packet(ColorBuffer& buffer, const PacketMask& packet, const PacketColor& src, const PacketColor& src1,
                            const BlendOperation& o, const glm::vec4& constant) {
  const std::size_t first = static_cast<std::size_t>(packet.packet) * kLanes;
  const Mask mask = mask_from_bits<Mask>(packet.lanes);
  if constexpr (format == ColorFormat::rgba8) {
    write_codes(buffer, first, mask, blended_codes(o, buffer, first, src, src1, constant));
  } else {
    PacketColor dst;
    for (int k = 0; k < 4; ++k) dst[static_cast<std::size_t>(k)] = read_channel<format>(buffer, first, k);
    const PacketColor out = blended_color(o, dst, is_fixed_point(format), src, src1, constant);
    if constexpr (is_fixed_point(format)) return write_codes(buffer, first, mask, packed_codes<format>(out));
    for (int k = 0; k < 4; ++k)
      store_halves(plane<uint16_t>(buffer, k) + first, Int(float_to_finite_half(out[static_cast<std::size_t>(k)])), mask);
  }
}

template <ColorFormat format, BlendOperation operation>
void blend_packets(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                   const BlendState& s) {
  for (std::size_t i = 0; i < packets.size(); ++i) blend_packet<format>(buffer, packets[i], src[i], src1[i], operation, s.constant);
}

template <ColorFormat format, BlendOperation operation>
void blend_one(ColorBuffer& buffer, PacketMask packet, const BlendState& s, Real r, Real g, Real b, Real a) {
  const PacketColor src{r, g, b, a};
  blend_packet<format>(buffer, packet, src, src, operation, s.constant);
}

// For all other states.
template <ColorFormat format>
void blend_by_state(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                    const BlendState& s) {
  const BlendOperation o = operation_of(s);
  for (std::size_t i = 0; i < packets.size(); ++i) blend_packet<format>(buffer, packets[i], src[i], src1[i], o, s.constant);
}

template <ColorFormat format>
void blend_one_by_state(ColorBuffer& buffer, PacketMask packet, const BlendState& s, Real r, Real g, Real b, Real a) {
  const PacketColor src{r, g, b, a};
  blend_by_state<format>(buffer, std::span(&packet, 1), &src, &src, s);
}

template <ColorFormat format>
constexpr BlendPrograms kByState{blend_by_state<format>, blend_one_by_state<format>};
template <ColorFormat format, BlendOperation operation>
constexpr BlendPrograms kCompiled{blend_packets<format, operation>, blend_one<format, operation>};

// Returns the operation of a state. The factors do not matter for the minimum and the maximum.
BlendOperation compiled_operation(const BlendState& s) {
  BlendOperation o = operation_of(s);
  const auto ignores_factors = [](BlendEquation e) { return e == BlendEquation::min || e == BlendEquation::max; };
  if (ignores_factors(o.color_equation) && ignores_factors(o.alpha_equation)) o.factors = {one, one, one, one};
  return o;
}

template <ColorFormat format>
BlendPrograms programs_of(const BlendState& s) {
  const BlendOperation operation = compiled_operation(s);
  if (operation == kOver) return kCompiled<format, kOver>;
  if (operation == kOverSameAlpha) return kCompiled<format, kOverSameAlpha>;
  if (operation == kPremultiplied) return kCompiled<format, kPremultiplied>;
  if (operation == kAddAlpha) return kCompiled<format, kAddAlpha>;
  if (operation == kAddSameAlpha) return kCompiled<format, kAddSameAlpha>;
  if (operation == kAdd) return kCompiled<format, kAdd>;
  if (operation == kMultiply) return kCompiled<format, kMultiply>;
  if (operation == kMultiplySource) return kCompiled<format, kMultiplySource>;
  if (operation == kConstant) return kCompiled<format, kConstant>;
  if (operation == kDualSource) return kCompiled<format, kDualSource>;
  if (operation == kDualSourceCoverage) return kCompiled<format, kDualSourceCoverage>;
  if (operation == kSubtractAlpha) return kCompiled<format, kSubtractAlpha>;
  if (operation == kMin) return kCompiled<format, kMin>;
  if (operation == kMax) return kCompiled<format, kMax>;
  return kByState<format>;
}

}  // namespace

BlendPrograms blend_programs(ColorFormat format, const BlendState& s) {
  switch (format) {
    case ColorFormat::rgba8: return programs_of<ColorFormat::rgba8>(s);
    case ColorFormat::srgb8a8: return programs_of<ColorFormat::srgb8a8>(s);
    case ColorFormat::rgba16f: return programs_of<ColorFormat::rgba16f>(s);
    default: return {};
  }
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
