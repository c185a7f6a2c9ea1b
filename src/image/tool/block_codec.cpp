// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool/block_codec.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <type_traits>

#include "halfspace/image/tool/block_bits.h"
#include "halfspace/image/tool/bptc.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kTexels = kBlockEdge * kBlockEdge;

using Rgba = std::array<uint8_t, 4>;

// Returns the integer nearest to numerator/denominator, both not negative.
constexpr uint32_t nearest(uint32_t numerator, uint32_t denominator) { return (2 * numerator + denominator) / (2 * denominator); }

// Returns 255·(first·a + second·b)/(first + second) for two RGB565 colors a and b with channels in [0, 1].
Rgba blend(uint32_t a, uint32_t b, uint32_t first, uint32_t second) {
  const auto channel = [&](int shift, uint32_t max) {
    return static_cast<uint8_t>(nearest(255 * (first * (a >> shift & max) + second * (b >> shift & max)), (first + second) * max));
  };
  return {channel(11, 31), channel(5, 63), channel(0, 31), 255};
}

// Decodes the colors of BC1 to BC3. may_have_black: whether the order of the colors selects blocks with a black, transparent color.
std::array<Rgba, kTexels> colors_of(const std::byte* block, bool may_have_black) {
  BlockBits bits(block, 8);
  const uint32_t a = bits.take(16), b = bits.take(16);
  std::array<Rgba, 4> palette = {blend(a, b, 1, 0), blend(a, b, 0, 1), blend(a, b, 2, 1), blend(a, b, 1, 2)};
  if (may_have_black && a <= b) {
    palette[2] = blend(a, b, 1, 1);
    palette[3] = {0, 0, 0, 0};
  }
  std::array<Rgba, kTexels> colors;
  for (Rgba& color : colors) color = palette[bits.take(2)];
  return colors;
}

// A channel of BC3 to BC5: 16 fractions with a common denominator. Their unit is the largest code.
struct Channel {
  int denominator = 1;
  std::array<int, kTexels> numerators = {};
};

// code(byte) converts the byte of an endpoint to a number from min to max.
template <class Code>
Channel channel_of(const std::byte* block, int min, int max, Code&& code) {
  BlockBits bits(block, 8);
  const int a = code(bits.take(8)), b = code(bits.take(8));
  const int steps = a > b ? 7 : 5;
  std::array<int, 8> palette = {steps * a, steps * b};
  for (int i = 1; i < steps; ++i) palette[static_cast<std::size_t>(i + 1)] = (steps - i) * a + i * b;
  if (steps == 5) {
    palette[6] = steps * min;
    palette[7] = steps * max;
  }
  Channel channel{steps, {}};
  for (int& numerator : channel.numerators) numerator = palette[bits.take(3)];
  return channel;
}

constexpr int kUnsignedMax = 255, kSignedMax = 127;

Channel unsigned_channel(const std::byte* block) {
  return channel_of(block, 0, kUnsignedMax, [](uint32_t byte) { return static_cast<int>(byte); });
}

// −128 is read as −127, also where the two endpoints are compared: the specification leaves open which of the two is smaller.
Channel signed_channel(const std::byte* block) {
  return channel_of(block, -kSignedMax, kSignedMax, [](uint32_t byte) { return std::max<int>(static_cast<int8_t>(byte), -kSignedMax); });
}

// Returns the number of type T nearest to texel i.
template <class T>
T value_of(const Channel& channel, std::size_t i, int max) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(static_cast<double>(channel.numerators[i]) / (channel.denominator * max));
  } else {
    return static_cast<T>(nearest(static_cast<uint32_t>(channel.numerators[i]) * std::numeric_limits<T>::max(),
                                  static_cast<uint32_t>(channel.denominator * max)));
  }
}

void store_colors(const std::array<Rgba, kTexels>& colors, std::size_t channels, std::byte* texels) {
  for (const Rgba& color : colors) {
    std::memcpy(texels, color.data(), channels);
    texels += channels;
  }
}

void decode_bc2(const std::byte* block, std::byte* texels) {
  std::array<Rgba, kTexels> colors = colors_of(block + 8, false);
  BlockBits alphas(block, 8);
  for (Rgba& color : colors) color[3] = static_cast<uint8_t>(17 * alphas.take(4));
  store_colors(colors, 4, texels);
}

void decode_bc3(const std::byte* block, std::byte* texels) {
  std::array<Rgba, kTexels> colors = colors_of(block + 8, false);
  const Channel alphas = unsigned_channel(block);
  for (std::size_t i = 0; i < kTexels; ++i) colors[i][3] = value_of<uint8_t>(alphas, i, kUnsignedMax);
  store_colors(colors, 4, texels);
}

// Stores one of `stride` channels.
template <class T>
void store_channel(const Channel& channel, int max, std::size_t stride, std::byte* texels) {
  for (std::size_t i = 0; i < kTexels; ++i) {
    const T value = value_of<T>(channel, i, max);
    std::memcpy(texels + i * stride * sizeof value, &value, sizeof value);
  }
}

template <class T>
void decode_bc5(const std::byte* block, Channel (*channel)(const std::byte*), int max, std::byte* texels) {
  std::fill_n(texels, 3 * kTexels * sizeof(T), std::byte{0});
  store_channel<T>(channel(block), max, 3, texels);
  store_channel<T>(channel(block + 8), max, 3, texels + sizeof(T));
}

void store_bc6h(const std::byte* block, bool is_signed, std::byte* texels) {
  std::array<float, 3 * kTexels> rgb;
  decode_bc6h(block, is_signed, rgb.data());
  std::memcpy(texels, rgb.data(), sizeof rgb);
}

}  // namespace

BlockInfo block_info(BlockFormat format) {
  switch (format) {
    case BlockFormat::bc1_opaque: return {8, 3, Sample::uint8};
    case BlockFormat::bc1: return {8, 4, Sample::uint8};
    case BlockFormat::bc2:
    case BlockFormat::bc3: return {16, 4, Sample::uint8};
    case BlockFormat::bc4: return {8, 1, Sample::uint16};
    case BlockFormat::bc4_signed: return {8, 1, Sample::float32};
    case BlockFormat::bc5: return {16, 3, Sample::uint16};
    case BlockFormat::bc5_signed:
    case BlockFormat::bc6h:
    case BlockFormat::bc6h_signed: return {16, 3, Sample::float32};
    case BlockFormat::bc7: break;
  }
  return {16, 4, Sample::uint8};
}

void decode_block(BlockFormat format, const std::byte* block, std::byte* texels) {
  switch (format) {
    case BlockFormat::bc1_opaque: return store_colors(colors_of(block, true), 3, texels);
    case BlockFormat::bc1: return store_colors(colors_of(block, true), 4, texels);
    case BlockFormat::bc2: return decode_bc2(block, texels);
    case BlockFormat::bc3: return decode_bc3(block, texels);
    case BlockFormat::bc4: return store_channel<uint16_t>(unsigned_channel(block), kUnsignedMax, 1, texels);
    case BlockFormat::bc4_signed: return store_channel<float>(signed_channel(block), kSignedMax, 1, texels);
    case BlockFormat::bc5: return decode_bc5<uint16_t>(block, unsigned_channel, kUnsignedMax, texels);
    case BlockFormat::bc5_signed: return decode_bc5<float>(block, signed_channel, kSignedMax, texels);
    case BlockFormat::bc6h: return store_bc6h(block, false, texels);
    case BlockFormat::bc6h_signed: return store_bc6h(block, true, texels);
    case BlockFormat::bc7: return decode_bc7(block, reinterpret_cast<uint8_t*>(texels));
  }
}

}  // namespace halfspace::HS_LANES
