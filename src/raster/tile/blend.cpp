// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/blend.h"

#include "halfspace/raster/tile/tile_format.h"

namespace halfspace {

namespace {

// Values that blend factors refer to. With a fixed-point attachment, src1 and constant must be clamped before use.
struct BlendSources {
  const PacketColor &src, &dst, &src1;
  const glm::vec4& constant;
  bool fixed_point;

  Real clamped(Real x) const { return fixed_point ? clamp(x, Real(0.0f), Real(1.0f)) : x; }
};

Real factor(BlendFactor f, const BlendSources& s, std::size_t k) {
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

Real combine(BlendEquation e, Real src, Real src_factor, Real dst, Real dst_factor) {
  switch (e) {
    case BlendEquation::add: return src * src_factor + dst * dst_factor;
    case BlendEquation::subtract: return src * src_factor - dst * dst_factor;
    case BlendEquation::reverse_subtract: return dst * dst_factor - src * src_factor;
    case BlendEquation::min: return min(src, dst);
    case BlendEquation::max: return max(src, dst);
  }
  return src;
}

PacketColor blend_colors(const BlendState& s, const BlendSources& from) {
  PacketColor out;
  for (std::size_t k = 0; k < 4; ++k) {
    const bool alpha = k == 3;
    const BlendFactor sf = alpha ? s.source_alpha : s.source_color;
    const BlendFactor df = alpha ? s.destination_alpha : s.destination_color;
    out[k] = combine(alpha ? s.alpha_equation : s.color_equation, from.src[k], factor(sf, from, k), from.dst[k], factor(df, from, k));
  }
  return out;
}

void write_packed(ColorBuffer& buffer, std::size_t first, Mask mask, const PacketColor& c, const ColorMask& channels) {
  Int packed = buffer.format == ColorFormat::srgb8a8 ? packed_codes<ColorFormat::srgb8a8>(c) : packed_codes<ColorFormat::rgba8>(c);
  int32_t* pixels = plane<int32_t>(buffer, 0) + first;
  const Int old = load<Int>(pixels);
  if (!channels.all()) {
    uint32_t kept = 0;
    for (int k = 0; k < 4; ++k) kept |= channels[k] ? 0u : 0xffu << (8 * k);
    const Int keep(static_cast<int32_t>(kept));
    packed = (old & keep) | (packed & ~keep);
  }
  store(pixels, select(mask, packed, old));
}

// Writes a format with one to three 32-bit channels.
void write_narrow(ColorBuffer& buffer, std::size_t first, Mask mask, const PacketColor& c, const ColorMask& channels) {
  for (int k = 0; k < narrow_channels(buffer.format); ++k) {
    if (!channels[k]) continue;
    float* to = plane<float>(buffer, k) + first;
    store(to, select(mask, c[static_cast<std::size_t>(k)], load<Real>(to)));
  }
}

template <ColorFormat format>
void replace_packed(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src) {
  for (std::size_t i = 0; i < packets.size(); ++i) {
    int32_t* pixels = plane<int32_t>(buffer, 0) + static_cast<std::size_t>(packets[i].packet) * kLanes;
    store(pixels, select(mask_from_bits<Mask>(packets[i].lanes), packed_codes<format>(src[i]), load<Int>(pixels)));
  }
}

template <ColorFormat format>
void read_packets(const ColorBuffer& buffer, std::span<const PacketMask> packets, PacketColor* out) {
  for (std::size_t i = 0; i < packets.size(); ++i) {
    for (int k = 0; k < 4; ++k)
      out[i][static_cast<std::size_t>(k)] = read_channel<format>(buffer, static_cast<std::size_t>(packets[i].packet) * kLanes, k);
  }
}

}  // namespace

void read_batch(const ColorBuffer& buffer, std::span<const PacketMask> packets, PacketColor* out) {
  switch (buffer.format) {
    case ColorFormat::none: return;
    case ColorFormat::rgba8: return read_packets<ColorFormat::rgba8>(buffer, packets, out);
    case ColorFormat::srgb8a8: return read_packets<ColorFormat::srgb8a8>(buffer, packets, out);
    case ColorFormat::rgba16f: return read_packets<ColorFormat::rgba16f>(buffer, packets, out);
    case ColorFormat::rgba32f: return read_packets<ColorFormat::rgba32f>(buffer, packets, out);
    case ColorFormat::r32f:
    case ColorFormat::r32ui: return read_packets<ColorFormat::r32f>(buffer, packets, out);
    case ColorFormat::rg32f: return read_packets<ColorFormat::rg32f>(buffer, packets, out);
    case ColorFormat::rgb32f: return read_packets<ColorFormat::rgb32f>(buffer, packets, out);
  }
}

PacketColor read_color(const ColorBuffer& buffer, int packet) {
  const PacketMask one{static_cast<uint16_t>(packet), static_cast<uint16_t>(kAllBits<Mask>)};
  PacketColor c;
  read_batch(buffer, std::span(&one, 1), &c);
  return c;
}

void write_color(ColorBuffer& buffer, int packet, Mask mask, const PacketColor& src, const PacketColor& src1,
                 const AttachmentState& state) {
  const std::size_t first = static_cast<std::size_t>(packet) * kLanes;
  const bool fixed_point = is_fixed_point(buffer.format);
  const auto write = [&](const PacketColor& c) {
    if (fixed_point) return write_packed(buffer, first, mask, c, state.mask);
    if (narrow_channels(buffer.format) != 0) return write_narrow(buffer, first, mask, c, state.mask);
    for (int k = 0; k < 4; ++k) {
      if (!state.mask[k]) continue;
      const Real value = c[static_cast<std::size_t>(k)];
      if (buffer.format == ColorFormat::rgba16f) {
        store_halves(plane<uint16_t>(buffer, k) + first, Int(float_to_finite_half(value)), mask);
      } else {
        float* to = plane<float>(buffer, k) + first;
        store(to, select(mask, value, load<Real>(to)));
      }
    }
  };
  if (!state.blend) return write(src);
  PacketColor c = src;
  if (fixed_point) {  // OpenGL 4.6, section 17.3.6: clamped before blending
    for (Real& x : c) x = clamp(x, Real(0.0f), Real(1.0f));
  }
  const PacketColor dst = read_color(buffer, packet);
  write(blend_colors(*state.blend, {c, dst, src1, state.blend->constant, fixed_point}));
}

void write_batch(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                 const AttachmentState& state) {
  if (!state.blend && state.mask.all()) {
    if (buffer.format == ColorFormat::rgba8) return replace_packed<ColorFormat::rgba8>(buffer, packets, src);
    if (buffer.format == ColorFormat::srgb8a8) return replace_packed<ColorFormat::srgb8a8>(buffer, packets, src);
  }
  for (std::size_t i = 0; i < packets.size(); ++i)
    write_color(buffer, packets[i].packet, mask_from_bits<Mask>(packets[i].lanes), src[i], src1[i], state);
}

bool uses_second_source(const BlendState& blend) {
  const auto second = [](BlendFactor f) { return f >= BlendFactor::src1_color && f <= BlendFactor::one_minus_src1_alpha; };
  return second(blend.source_color) || second(blend.destination_color) || second(blend.source_alpha) || second(blend.destination_alpha);
}

}  // namespace halfspace
