// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string_view>

#include "halfspace/core/half.h"
#include "halfspace/image/tool/block_bits.h"
#include "halfspace/image/tool/bptc.h"
#include "halfspace/image/tool/bptc_tables.h"

namespace halfspace::HS_LANES {

namespace {

// Fields of a block: 4 endpoints of each channel, as 4·channel + endpoint, and the number of the partition.
constexpr int kPartition = 12, kFields = 13;
// Numbers of bits after the mode and before the indices: the largest, and that of all modes with one subset.
constexpr int kMaxPlaces = 80, kPlacesOfOneSubset = 60;

// Where a bit of a block belongs: a field and its bit.
struct Place {
  uint8_t field = 0, bit = 0;
};

struct Mode {
  uint32_t number = 0;
  bool is_transformed = false;         // endpoints 1 to 3 are differences from endpoint 0
  int bits = 0;                        // per channel of endpoint 0
  std::array<int, 3> later_bits = {};  // of endpoints 1 to 3, for each channel
  int places_count = 0;
  std::array<Place, kMaxPlaces> places = {};

  constexpr int subsets() const { return places_count == kPlacesOfOneSubset ? 1 : 2; }
};

// `layout` lists the fields of a block after the mode, as the specification does: "R0:9-0" means that the next ten bits are bits 0 to 9 of
// the red channel of endpoint 0, and "R0:10-11" that the next two are its bits 11 and 10, in this order.
consteval Mode mode_of(uint32_t number, bool is_transformed, int bits, std::array<int, 3> later_bits, std::string_view layout) {
  Mode mode{number, is_transformed, bits, later_bits};
  const auto take_number = [&] {
    int n = 0;
    for (; !layout.empty() && layout[0] >= '0' && layout[0] <= '9'; layout.remove_prefix(1)) n = 10 * n + (layout[0] - '0');
    return n;
  };
  while (!layout.empty()) {
    const char channel = layout[0];
    const int endpoint = channel == 'P' ? 0 : layout[1] - '0';
    const int field = channel == 'P' ? kPartition : 4 * (channel == 'R' ? 0 : channel == 'G' ? 1 : 2) + endpoint;
    layout.remove_prefix(3);
    const int end = take_number();
    int begin = end;
    if (!layout.empty() && layout[0] == '-') {
      layout.remove_prefix(1);
      begin = take_number();
    }
    const int step = end >= begin ? 1 : -1;
    for (int bit = begin; bit != end + step; bit += step)
      mode.places[static_cast<std::size_t>(mode.places_count++)] = {static_cast<uint8_t>(field), static_cast<uint8_t>(bit)};
    if (!layout.empty()) layout.remove_prefix(1);  // the space
  }
  return mode;
}

constexpr std::array<Mode, 14> kModes = {
    mode_of(0, true, 10, {5, 5, 5},
            "G2:4 B2:4 B3:4 R0:9-0 G0:9-0 B0:9-0 R1:4-0 G3:4 G2:3-0 G1:4-0 B3:0 G3:3-0 B1:4-0 B3:1 B2:3-0 R2:4-0 B3:2 R3:4-0 B3:3 PB:4-0"),
    mode_of(1, true, 7, {6, 6, 6},
            "G2:5 G3:4 G3:5 R0:6-0 B3:0 B3:1 B2:4 G0:6-0 B2:5 B3:2 G2:4 B0:6-0 B3:3 B3:5 B3:4 R1:5-0 G2:3-0 G1:5-0 G3:3-0 B1:5-0 B2:3-0 "
            "R2:5-0 R3:5-0 PB:4-0"),
    mode_of(2, true, 11, {5, 4, 4},
            "R0:9-0 G0:9-0 B0:9-0 R1:4-0 R0:10 G2:3-0 G1:3-0 G0:10 B3:0 G3:3-0 B1:3-0 B0:10 B3:1 B2:3-0 R2:4-0 B3:2 R3:4-0 B3:3 PB:4-0"),
    mode_of(6, true, 11, {4, 5, 4},
            "R0:9-0 G0:9-0 B0:9-0 R1:3-0 R0:10 G3:4 G2:3-0 G1:4-0 G0:10 G3:3-0 B1:3-0 B0:10 B3:1 B2:3-0 R2:3-0 B3:0 B3:2 R3:3-0 G2:4 "
            "B3:3 PB:4-0"),
    mode_of(10, true, 11, {4, 4, 5},
            "R0:9-0 G0:9-0 B0:9-0 R1:3-0 R0:10 B2:4 G2:3-0 G1:3-0 G0:10 B3:0 G3:3-0 B1:4-0 B0:10 B2:3-0 R2:3-0 B3:1 B3:2 R3:3-0 B3:4 "
            "B3:3 PB:4-0"),
    mode_of(14, true, 9, {5, 5, 5},
            "R0:8-0 B2:4 G0:8-0 G2:4 B0:8-0 B3:4 R1:4-0 G3:4 G2:3-0 G1:4-0 B3:0 G3:3-0 B1:4-0 B3:1 B2:3-0 R2:4-0 B3:2 R3:4-0 B3:3 PB:4-0"),
    mode_of(18, true, 8, {6, 5, 5},
            "R0:7-0 G3:4 B2:4 G0:7-0 B3:2 G2:4 B0:7-0 B3:3 B3:4 R1:5-0 G2:3-0 G1:4-0 B3:0 G3:3-0 B1:4-0 B3:1 B2:3-0 R2:5-0 R3:5-0 PB:4-0"),
    mode_of(22, true, 8, {5, 6, 5},
            "R0:7-0 B3:0 B2:4 G0:7-0 G2:5 G2:4 B0:7-0 G3:5 B3:4 R1:4-0 G3:4 G2:3-0 G1:5-0 G3:3-0 B1:4-0 B3:1 B2:3-0 R2:4-0 B3:2 R3:4-0 "
            "B3:3 PB:4-0"),
    mode_of(26, true, 8, {5, 5, 6},
            "R0:7-0 B3:1 B2:4 G0:7-0 B2:5 G2:4 B0:7-0 B3:5 B3:4 R1:4-0 G3:4 G2:3-0 G1:4-0 B3:0 G3:3-0 B1:5-0 B2:3-0 R2:4-0 B3:2 R3:4-0 "
            "B3:3 PB:4-0"),
    mode_of(30, false, 6, {6, 6, 6},
            "R0:5-0 G3:4 B3:0 B3:1 B2:4 G0:5-0 G2:5 B2:5 B3:2 G2:4 B0:5-0 G3:5 B3:3 B3:5 B3:4 R1:5-0 G2:3-0 G1:5-0 G3:3-0 B1:5-0 B2:3-0 "
            "R2:5-0 R3:5-0 PB:4-0"),
    mode_of(3, false, 10, {10, 10, 10}, "R0:9-0 G0:9-0 B0:9-0 R1:9-0 G1:9-0 B1:9-0"),
    mode_of(7, true, 11, {9, 9, 9}, "R0:9-0 G0:9-0 B0:9-0 R1:8-0 R0:10 G1:8-0 G0:10 B1:8-0 B0:10"),
    mode_of(11, true, 12, {8, 8, 8}, "R0:9-0 G0:9-0 B0:9-0 R1:7-0 R0:10-11 G1:7-0 G0:10-11 B1:7-0 B0:10-11"),
    mode_of(15, true, 16, {4, 4, 4}, "R0:9-0 G0:9-0 B0:9-0 R1:3-0 R0:10-15 G1:3-0 G0:10-15 B1:3-0 B0:10-15"),
};

// Returns the number whose two's complement representation is the lowest `bits` bits of x.
int with_sign(uint32_t x, int bits) { return static_cast<int>(x << (32 - bits)) >> (32 - bits); }

// Scales an endpoint of `bits` bits to 16 bits.
int unquantized(int x, int bits, bool is_signed) {
  if (!is_signed) {
    if (bits >= 15 || x == 0) return x;
    return x == (1 << bits) - 1 ? 0xffff : ((x << 15) + 0x4000) >> (bits - 1);
  }
  if (bits >= 16 || x == 0) return x;
  const int magnitude = x < 0 ? -x : x;
  const int scaled = magnitude >= (1 << (bits - 1)) - 1 ? 0x7fff : ((magnitude << 15) + 0x4000) >> (bits - 1);
  return x < 0 ? -scaled : scaled;
}

// Returns the half that an interpolated value stands for.
uint16_t half_of(int x, bool is_signed) {
  if (!is_signed) return static_cast<uint16_t>((x * 31) >> 6);
  return static_cast<uint16_t>(x < 0 ? ((-x * 31) >> 5) | 0x8000 : (x * 31) >> 5);
}

// Returns the endpoint of a channel, scaled to 16 bits.
int endpoint_of(const std::array<uint32_t, kFields>& fields, const Mode& mode, std::size_t channel, std::size_t endpoint, bool is_signed) {
  const uint32_t base = fields[4 * channel], code = fields[4 * channel + endpoint];
  uint32_t x = code;
  if (endpoint > 0 && mode.is_transformed) x = base + static_cast<uint32_t>(with_sign(code, mode.later_bits[channel]));
  const int value = is_signed ? with_sign(x, mode.bits) : static_cast<int>(x & ((1u << mode.bits) - 1));
  return unquantized(value, mode.bits, is_signed);
}

}  // namespace

void decode_bc6h(const std::byte* block, bool is_signed, float* rgb) {
  BlockBits bits(block, 16);
  uint32_t number = bits.take(2);
  if (number >= 2) number |= bits.take(3) << 2;
  const auto mode = std::ranges::find(kModes, number, &Mode::number);
  if (mode == kModes.end()) {
    std::fill_n(rgb, 3 * kBlockTexels, 0.0f);
    return;
  }
  std::array<uint32_t, kFields> fields = {};
  for (int i = 0; i < mode->places_count; ++i) {
    const Place place = mode->places[static_cast<std::size_t>(i)];
    fields[place.field] |= bits.take(1) << place.bit;
  }
  const int subsets = mode->subsets(), index_bits = subsets == 2 ? 3 : 4;
  std::array<std::array<int, 4>, 3> ends = {};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t e = 0; e < 2 * static_cast<std::size_t>(subsets); ++e) ends[c][e] = endpoint_of(fields, *mode, c, e, is_signed);
  }
  const uint32_t partition = fields[kPartition];
  for (int i = 0; i < kBlockTexels; ++i, rgb += 3) {
    const uint32_t index = bits.take(index_bits - (is_anchor(subsets, partition, i) ? 1 : 0));
    const std::size_t e = 2 * static_cast<std::size_t>(subset_of(subsets, partition, i));
    for (std::size_t c = 0; c < 3; ++c)
      rgb[c] = half_to_float(half_of(bptc_blend(ends[c][e], ends[c][e + 1], index_bits, index), is_signed));
  }
}

}  // namespace halfspace::HS_LANES
