// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/blend_programs.h"

#include <array>

#include "halfspace/raster/tile/blend_formulas.h"
#include "halfspace/raster/tile/tile_format.h"

namespace halfspace {

namespace {

// The equation is `add`.
struct BlendFactors {
  BlendFactor source_color, destination_color, source_alpha, destination_alpha;

  bool operator==(const BlendFactors&) const = default;
};

using enum BlendFactor;
constexpr BlendFactors kOver{src_alpha, one_minus_src_alpha, one, one_minus_src_alpha};
constexpr BlendFactors kOverSameAlpha{src_alpha, one_minus_src_alpha, src_alpha, one_minus_src_alpha};
constexpr BlendFactors kPremultiplied{one, one_minus_src_alpha, one, one_minus_src_alpha};
constexpr BlendFactors kAddAlpha{src_alpha, one, one, one};
constexpr BlendFactors kAddSameAlpha{src_alpha, one, src_alpha, one};
constexpr BlendFactors kAdd{one, one, one, one};
constexpr BlendFactors kMultiply{dst_color, zero, dst_color, zero};
constexpr BlendFactors kMultiplySource{zero, src_color, zero, src_color};

template <ColorFormat format>
HS_INLINE void write_packet(ColorBuffer& buffer, std::size_t first, Mask mask, const PacketColor& c) {
  if constexpr (is_fixed_point(format)) {
    int32_t* pixels = plane<int32_t>(buffer, 0) + first;
    store(pixels, select(mask, packed_codes<format>(c), load<Int>(pixels)));
  } else {
    for (int k = 0; k < 4; ++k)
      store_halves(plane<uint16_t>(buffer, k) + first, Int(float_to_finite_half(c[static_cast<std::size_t>(k)])), mask);
  }
}

// Blends one packet. The compiler evaluates the switches in the formulas if the state is a constant.
template <ColorFormat format>
HS_INLINE void blend_packet(ColorBuffer& buffer, const PacketMask& packet, PacketColor src, const PacketColor& src1,
                            const BlendEquation& color_equation, const BlendEquation& alpha_equation, const BlendFactors& factors,
                            const glm::vec4& constant) {
  const std::size_t first = static_cast<std::size_t>(packet.packet) * kLanes;
  PacketColor dst, out;
  for (int k = 0; k < 4; ++k) dst[static_cast<std::size_t>(k)] = read_channel<format>(buffer, first, k);
  if constexpr (is_fixed_point(format)) {  // OpenGL 4.6, section 17.3.6: clamped before blending
    for (Real& x : src) x = clamp(x, Real(0.0f), Real(1.0f));
  }
  const BlendSources from{src, dst, src1, constant, is_fixed_point(format)};
  for (std::size_t k = 0; k < 4; ++k) {
    const Real source = blend_factor(k == 3 ? factors.source_alpha : factors.source_color, from, k);
    const Real destination = blend_factor(k == 3 ? factors.destination_alpha : factors.destination_color, from, k);
    out[k] = blend_sum(k == 3 ? alpha_equation : color_equation, src[k], source, dst[k], destination);
  }
  write_packet<format>(buffer, first, mask_from_bits<Mask>(packet.lanes), out);
}

template <ColorFormat format, BlendFactors factors>
void blend_packets(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor*,
                   const BlendState&) {
  constexpr glm::vec4 no_constant(0.0f);
  for (std::size_t i = 0; i < packets.size(); ++i)
    blend_packet<format>(buffer, packets[i], src[i], src[i], BlendEquation::add, BlendEquation::add, factors, no_constant);
}

// For all other states.
template <ColorFormat format>
void blend_by_state(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                    const BlendState& s) {
  const BlendFactors factors{s.source_color, s.destination_color, s.source_alpha, s.destination_alpha};
  for (std::size_t i = 0; i < packets.size(); ++i)
    blend_packet<format>(buffer, packets[i], src[i], src1[i], s.color_equation, s.alpha_equation, factors, s.constant);
}

template <ColorFormat format>
BlendProgram program_of(const BlendState& s) {
  if (s.color_equation != BlendEquation::add || s.alpha_equation != BlendEquation::add) return blend_by_state<format>;
  const BlendFactors factors{s.source_color, s.destination_color, s.source_alpha, s.destination_alpha};
  if (factors == kOver) return blend_packets<format, kOver>;
  if (factors == kOverSameAlpha) return blend_packets<format, kOverSameAlpha>;
  if (factors == kPremultiplied) return blend_packets<format, kPremultiplied>;
  if (factors == kAddAlpha) return blend_packets<format, kAddAlpha>;
  if (factors == kAddSameAlpha) return blend_packets<format, kAddSameAlpha>;
  if (factors == kAdd) return blend_packets<format, kAdd>;
  if (factors == kMultiply) return blend_packets<format, kMultiply>;
  if (factors == kMultiplySource) return blend_packets<format, kMultiplySource>;
  return blend_by_state<format>;
}

}  // namespace

BlendProgram blend_program(ColorFormat format, const BlendState& s) {
  switch (format) {
    case ColorFormat::rgba8: return program_of<ColorFormat::rgba8>(s);
    case ColorFormat::srgb8a8: return program_of<ColorFormat::srgb8a8>(s);
    case ColorFormat::rgba16f: return program_of<ColorFormat::rgba16f>(s);
    default: return nullptr;
  }
}

}  // namespace halfspace
