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

template <ColorFormat format, BlendFactors factors>
void blend_packets(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* colors) {
  constexpr glm::vec4 no_constant(0.0f);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const std::size_t first = static_cast<std::size_t>(packets[i].packet) * kLanes;
    PacketColor src = colors[i], dst, out;
    for (int k = 0; k < 4; ++k) dst[static_cast<std::size_t>(k)] = read_channel<format>(buffer, first, k);
    if constexpr (is_fixed_point(format)) {
      for (Real& x : src) x = clamp(x, Real(0.0f), Real(1.0f));
    }
    const BlendSources from{src, dst, src, no_constant, is_fixed_point(format)};
    for (std::size_t k = 0; k < 4; ++k) {
      const Real source = blend_factor(k == 3 ? factors.source_alpha : factors.source_color, from, k);
      const Real destination = blend_factor(k == 3 ? factors.destination_alpha : factors.destination_color, from, k);
      out[k] = blend_sum(BlendEquation::add, src[k], source, dst[k], destination);
    }
    write_packet<format>(buffer, first, mask_from_bits<Mask>(packets[i].lanes), out);
  }
}

template <ColorFormat format>
BlendProgram program_of(const BlendFactors& factors) {
  if (factors == kOver) return blend_packets<format, kOver>;
  if (factors == kOverSameAlpha) return blend_packets<format, kOverSameAlpha>;
  if (factors == kPremultiplied) return blend_packets<format, kPremultiplied>;
  if (factors == kAddAlpha) return blend_packets<format, kAddAlpha>;
  if (factors == kAddSameAlpha) return blend_packets<format, kAddSameAlpha>;
  if (factors == kAdd) return blend_packets<format, kAdd>;
  if (factors == kMultiply) return blend_packets<format, kMultiply>;
  if (factors == kMultiplySource) return blend_packets<format, kMultiplySource>;
  return nullptr;
}

}  // namespace

BlendProgram blend_program(ColorFormat format, const BlendState& s) {
  if (s.color_equation != BlendEquation::add || s.alpha_equation != BlendEquation::add) return nullptr;
  const BlendFactors factors{s.source_color, s.destination_color, s.source_alpha, s.destination_alpha};
  switch (format) {
    case ColorFormat::rgba8: return program_of<ColorFormat::rgba8>(factors);
    case ColorFormat::srgb8a8: return program_of<ColorFormat::srgb8a8>(factors);
    case ColorFormat::rgba16f: return program_of<ColorFormat::rgba16f>(factors);
    default: return nullptr;
  }
}

}  // namespace halfspace
