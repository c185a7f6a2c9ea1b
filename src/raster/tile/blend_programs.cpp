// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/blend_programs.h"

#include <array>

#include "halfspace/raster/tile/blend_formulas.h"
#include "halfspace/raster/tile/tile_format.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

struct BlendFactors {
  BlendFactor source_color, destination_color, source_alpha, destination_alpha;

  bool operator==(const BlendFactors&) const = default;
};
// A state that is known at compile time. Color and alpha have the same equation.
struct BlendOperation {
  BlendEquation equation;
  BlendFactors factors;

  bool operator==(const BlendOperation&) const = default;
};

using enum BlendFactor;
constexpr BlendOperation sum_of(const BlendFactors& factors) { return {BlendEquation::add, factors}; }
constexpr BlendOperation kOver = sum_of({src_alpha, one_minus_src_alpha, one, one_minus_src_alpha});
constexpr BlendOperation kOverSameAlpha = sum_of({src_alpha, one_minus_src_alpha, src_alpha, one_minus_src_alpha});
constexpr BlendOperation kPremultiplied = sum_of({one, one_minus_src_alpha, one, one_minus_src_alpha});
constexpr BlendOperation kAddAlpha = sum_of({src_alpha, one, one, one});
constexpr BlendOperation kAddSameAlpha = sum_of({src_alpha, one, src_alpha, one});
constexpr BlendOperation kAdd = sum_of({one, one, one, one});
constexpr BlendOperation kMultiply = sum_of({dst_color, zero, dst_color, zero});
constexpr BlendOperation kMultiplySource = sum_of({zero, src_color, zero, src_color});
constexpr BlendOperation kConstant = sum_of({constant_color, one_minus_constant_color, constant_color, one_minus_constant_color});
constexpr BlendOperation kSubtractAlpha{BlendEquation::reverse_subtract, {src_alpha, one, src_alpha, one}};
constexpr BlendOperation kMin{BlendEquation::min, {one, one, one, one}};
constexpr BlendOperation kMax{BlendEquation::max, {one, one, one, one}};

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

template <ColorFormat format, BlendOperation operation>
void blend_packets(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor*,
                   const BlendState& s) {
  for (std::size_t i = 0; i < packets.size(); ++i)
    blend_packet<format>(buffer, packets[i], src[i], src[i], operation.equation, operation.equation, operation.factors, s.constant);
}

template <ColorFormat format, BlendOperation operation>
void blend_one(ColorBuffer& buffer, PacketMask packet, const BlendState& s, Real r, Real g, Real b, Real a) {
  const PacketColor src{r, g, b, a};
  blend_packet<format>(buffer, packet, src, src, operation.equation, operation.equation, operation.factors, s.constant);
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
void blend_one_by_state(ColorBuffer& buffer, PacketMask packet, const BlendState& s, Real r, Real g, Real b, Real a) {
  const PacketColor src{r, g, b, a};
  blend_by_state<format>(buffer, std::span(&packet, 1), &src, &src, s);
}

template <ColorFormat format>
constexpr BlendPrograms kByState{blend_by_state<format>, blend_one_by_state<format>};
template <ColorFormat format, BlendOperation operation>
constexpr BlendPrograms kCompiled{blend_packets<format, operation>, blend_one<format, operation>};

// Returns the factors of a state. They do not matter for the minimum and the maximum.
BlendFactors factors_of(const BlendState& s) {
  if (s.color_equation == BlendEquation::min || s.color_equation == BlendEquation::max) return {one, one, one, one};
  return {s.source_color, s.destination_color, s.source_alpha, s.destination_alpha};
}

template <ColorFormat format>
BlendPrograms programs_of(const BlendState& s) {
  if (s.color_equation != s.alpha_equation) return kByState<format>;
  const BlendOperation operation{s.color_equation, factors_of(s)};
  if (operation == kOver) return kCompiled<format, kOver>;
  if (operation == kOverSameAlpha) return kCompiled<format, kOverSameAlpha>;
  if (operation == kPremultiplied) return kCompiled<format, kPremultiplied>;
  if (operation == kAddAlpha) return kCompiled<format, kAddAlpha>;
  if (operation == kAddSameAlpha) return kCompiled<format, kAddSameAlpha>;
  if (operation == kAdd) return kCompiled<format, kAdd>;
  if (operation == kMultiply) return kCompiled<format, kMultiply>;
  if (operation == kMultiplySource) return kCompiled<format, kMultiplySource>;
  if (operation == kConstant) return kCompiled<format, kConstant>;
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
