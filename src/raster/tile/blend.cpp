// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/blend.h"

#include "halfspace/raster/tile/blend_codes.h"
#include "halfspace/raster/tile/tile_format.h"
#include "halfspace/raster/tile/write_programs.h"

namespace halfspace::HS_LANES {

namespace {

// Writes a format with planes of words.
void write_planes(ColorBuffer& buffer, std::size_t first, Mask mask, const PacketColor& color, const ColorMask& channels) {
  const PacketColor nearest = nearest_color(buffer.format, color);
  for (int k = 0; k < word_planes(buffer.format); ++k) {
    if (!channels[k]) continue;
    float* to = plane<float>(buffer, k) + first;
    store(to, select(mask, nearest[static_cast<std::size_t>(k)], load<Real>(to)));
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
    case ColorFormat::rgba8: return read_packets<ColorFormat::rgba8>(buffer, packets, out);
    case ColorFormat::srgb8a8: return read_packets<ColorFormat::srgb8a8>(buffer, packets, out);
    case ColorFormat::rgba16f: return read_packets<ColorFormat::rgba16f>(buffer, packets, out);
    default: break;
  }
  switch (word_planes(buffer.format)) {
    case 1: return read_packets<ColorFormat::r32f>(buffer, packets, out);
    case 2: return read_packets<ColorFormat::rg32f>(buffer, packets, out);
    case 3: return read_packets<ColorFormat::rgb32f>(buffer, packets, out);
    case 4: return read_packets<ColorFormat::rgba32f>(buffer, packets, out);
    default: return;
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
  const auto write_enabled = [&](Int codes) {
    write_codes(buffer, first, mask, state.mask.all() ? codes : merged_codes(codes, read_codes(buffer, first), state.mask));
  };
  const std::optional<BlendState>& blend = state.blend;
  if (blend && buffer.format == ColorFormat::rgba8)
    return write_enabled(blended_codes(operation_of(*blend), buffer, first, src, src1, blend->constant));
  const PacketColor c =
      blend ? blended_color(operation_of(*blend), read_color(buffer, packet), buffer.format, src, src1, blend->constant) : src;
  if (buffer.format == ColorFormat::rgba8) return write_enabled(packed_codes<ColorFormat::rgba8>(c));
  if (buffer.format == ColorFormat::srgb8a8) return write_enabled(packed_codes<ColorFormat::srgb8a8>(c));
  if (buffer.format != ColorFormat::rgba16f) return write_planes(buffer, first, mask, c, state.mask);
  for (int k = 0; k < 4; ++k) {
    if (state.mask[k]) store_halves(plane<uint16_t>(buffer, k) + first, c[static_cast<std::size_t>(k)], mask);
  }
}

void write_batch(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                 const AttachmentState& state) {
  const WriteProgram program = write_program(buffer.format, state);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    if (program != nullptr) {
      program(buffer, packets[i], state, src[i][0], src[i][1], src[i][2], src[i][3], &src1[i]);
    } else {
      write_color(buffer, packets[i].packet, mask_from_bits<Mask>(packets[i].lanes), src[i], src1[i], state);
    }
  }
}

bool uses_second_source(const BlendState& blend) {
  const auto second = [](BlendFactor f) { return f >= BlendFactor::src1_color && f <= BlendFactor::one_minus_src1_alpha; };
  return second(blend.source_color) || second(blend.destination_color) || second(blend.source_alpha) || second(blend.destination_alpha);
}

}  // namespace halfspace::HS_LANES
