// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <bit>
#include <utility>

#include "halfspace/image/tool/block_bits.h"
#include "halfspace/image/tool/bptc.h"
#include "halfspace/image/tool/bptc_tables.h"

namespace halfspace::HS_LANES {

namespace {

// The parameters of a mode, in the order of their fields in a block.
struct Mode {
  int subsets, partition_bits, rotation_bits, selection_bits, color_bits, alpha_bits;
  int endpoint_low_bits, shared_low_bits;  // per endpoint and per subset
  int index_bits, second_index_bits;
};
constexpr std::array<Mode, 8> kModes = {{
    {3, 4, 0, 0, 4, 0, 1, 0, 3, 0},
    {2, 6, 0, 0, 6, 0, 0, 1, 3, 0},
    {3, 6, 0, 0, 5, 0, 0, 0, 2, 0},
    {2, 6, 0, 0, 7, 0, 1, 0, 2, 0},
    {1, 0, 2, 1, 5, 6, 0, 0, 2, 3},
    {1, 0, 2, 0, 7, 8, 0, 0, 2, 2},
    {1, 0, 0, 0, 7, 7, 1, 0, 4, 0},
    {2, 6, 0, 0, 5, 5, 1, 0, 2, 0},
}};

constexpr int kAlpha = 3, kMaxEndpoints = 6;

using Endpoints = std::array<std::array<int, 4>, kMaxEndpoints>;
using Indices = std::array<uint32_t, kBlockTexels>;

// Converts a number of 4 to 8 bits to 8 bits: the highest bits are repeated below.
int to_8_bits(uint32_t x, int bits) {
  const uint32_t high = x << (8 - bits);
  return static_cast<int>(high | high >> bits);
}

Endpoints take_endpoints(BlockBits& bits, const Mode& mode) {
  const std::size_t count = 2 * static_cast<std::size_t>(mode.subsets);
  std::array<std::array<uint32_t, 4>, kMaxEndpoints> codes = {};
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t e = 0; e < count; ++e) codes[e][c] = bits.take(c == kAlpha ? mode.alpha_bits : mode.color_bits);
  }
  uint32_t low = 0;
  const int low_bits = mode.endpoint_low_bits | mode.shared_low_bits;
  Endpoints endpoints = {};
  for (std::size_t e = 0; e < count; ++e) {
    if (mode.endpoint_low_bits != 0 || (mode.shared_low_bits != 0 && e % 2 == 0)) low = bits.take(1);
    for (std::size_t c = 0; c < 4; ++c) {
      const int stored = c == kAlpha ? mode.alpha_bits : mode.color_bits;
      endpoints[e][c] = stored == 0 ? 255 : to_8_bits(codes[e][c] << low_bits | low, stored + low_bits);
    }
  }
  return endpoints;
}

Indices take_indices(BlockBits& bits, const Mode& mode, uint32_t partition, int index_bits) {
  Indices indices = {};
  if (index_bits == 0) return indices;
  for (int i = 0; i < kBlockTexels; ++i)
    indices[static_cast<std::size_t>(i)] = bits.take(index_bits - (is_anchor(mode.subsets, partition, i) ? 1 : 0));
  return indices;
}

}  // namespace

void decode_bc7(const std::byte* block, std::uint8_t* rgba) {
  const auto number = static_cast<std::size_t>(std::countr_zero(std::to_integer<uint8_t>(block[0])));
  if (number >= kModes.size()) {
    std::fill_n(rgba, 4 * kBlockTexels, uint8_t{0});
    return;
  }
  const Mode& mode = kModes[number];
  BlockBits bits(block, 16);
  bits.take(static_cast<int>(number) + 1);
  const uint32_t partition = bits.take(mode.partition_bits), rotation = bits.take(mode.rotation_bits);
  const bool exchanged = bits.take(mode.selection_bits) != 0;  // colors use the second indices, and alpha the first
  const Endpoints endpoints = take_endpoints(bits, mode);
  const Indices first = take_indices(bits, mode, partition, mode.index_bits);
  const Indices second = take_indices(bits, mode, partition, mode.second_index_bits);
  const bool has_second = mode.second_index_bits != 0;
  for (int i = 0; i < kBlockTexels; ++i, rgba += 4) {
    const std::size_t e = 2 * static_cast<std::size_t>(subset_of(mode.subsets, partition, i));
    for (std::size_t c = 0; c < 4; ++c) {
      const bool uses_second = has_second && (c == kAlpha) != exchanged;
      rgba[c] =
          static_cast<uint8_t>(bptc_blend(endpoints[e][c], endpoints[e + 1][c], uses_second ? mode.second_index_bits : mode.index_bits,
                                          (uses_second ? second : first)[static_cast<std::size_t>(i)]));
    }
    if (rotation != 0) std::swap(rgba[kAlpha], rgba[rotation - 1]);
  }
}

}  // namespace halfspace::HS_LANES
