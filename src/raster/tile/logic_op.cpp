// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/logic_op.h"

#include "halfspace/raster/tile/tile_format.h"

namespace halfspace::HS_LANES {

namespace {

Int combined(LogicOp op, Int s, Int d) {
  const auto bits = static_cast<unsigned>(op);
  Int result(0);
  if ((bits & 1) != 0) result = result | (s & d);
  if ((bits & 2) != 0) result = result | (s & ~d);
  if ((bits & 4) != 0) result = result | (~s & d);
  if ((bits & 8) != 0) result = result | (~s & ~d);
  return result;
}

// Returns the code of a channel in the low bits. Signed codes are sign-extended.
Int code_in(const TexelInfo& info, Real value, int bits) {
  return info.kind == TexelKind::unorm ? encode_unorm(value, bits) : as_int(value);
}

// Returns the value of a code. Bits that the format does not have are ignored.
Real value_of(const TexelInfo& info, Int code, int bits) {
  const int unused = 32 - bits;
  if (info.kind == TexelKind::sints) return as_real((code << unused) >> unused);
  const Int low = unused == 0 ? code : code & Int((1 << bits) - 1);
  return info.kind == TexelKind::unorm ? decode_unorm<Real>(low, bits) : as_real(low);
}

}  // namespace

bool has_logic_op(ColorFormat format) {
  const TexelKind kind = texel_info(format).kind;
  return kind == TexelKind::unorm || is_integer(format);
}

void write_logic_op(ColorBuffer& buffer, int packet, Mask mask, const PacketColor& color, LogicOp op, const ColorMask& channels) {
  const std::size_t first = static_cast<std::size_t>(packet) * kLanes;
  if (buffer.format == ColorFormat::rgba8) {
    const Int old = read_codes(buffer, first);
    return write_codes(buffer, first, mask, merged_codes(combined(op, packed_codes<ColorFormat::rgba8>(color), old), old, channels));
  }
  const TexelInfo& info = texel_info(buffer.format);
  const PacketColor nearest = nearest_color(buffer.format, color);
  for (int k = 0; k < word_planes(buffer.format); ++k) {
    if (!channels[k]) continue;
    const int bits = channel_bits(buffer.format, k);
    float* to = plane<float>(buffer, k) + first;
    const Real old = load<Real>(to);
    const Int code = combined(op, code_in(info, nearest[static_cast<std::size_t>(k)], bits), code_in(info, old, bits));
    store(to, select(mask, value_of(info, code, bits), old));
  }
}

}  // namespace halfspace::HS_LANES
