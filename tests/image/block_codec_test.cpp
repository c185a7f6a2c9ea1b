// SPDX-License-Identifier: Apache-2.0
//
// Decodes blocks that the tests write, as DDS and KTX2 files. Most expected values are closed forms of the Khronos Data Format
// Specification 1.3.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "halfspace/core/half.h"
#include "halfspace/image/image_io.h"
#include "image/image_fixture.h"
#include "image/texture_files.h"

namespace halfspace::block_codec_test {
namespace {

using BlockCodec = ImageToolTest;

// Values of DXGI_FORMAT and VkFormat.
constexpr uint32_t kBc1 = 71, kBc2 = 74, kBc3 = 77, kBc4 = 80, kBc4Signed = 81, kBc5 = 83, kBc5Signed = 84, kBc6h = 95, kBc6hSigned = 96,
                   kBc7 = 98, kVkBc1Opaque = 131;

std::span<const std::byte> bytes_of(const std::string& file) { return std::as_bytes(std::span(file)); }

Image<glm::u8vec4> codes_of(uint32_t format, uint32_t width, uint32_t height, const std::string& blocks) {
  return read_image(bytes_of(dxgi_dds(format, width, height, blocks)), "codes");
}
Image<float> numbers_of(uint32_t format, uint32_t width, uint32_t height, const std::string& blocks) {
  return read_gray(bytes_of(dxgi_dds(format, width, height, blocks)), "numbers");
}
Image<glm::vec4> colors_of(uint32_t format, uint32_t width, uint32_t height, const std::string& blocks) {
  return read_linear(bytes_of(dxgi_dds(format, width, height, blocks)), "colors");
}

template <class Texel>
Texel texel_of(const Image<Texel>& block, int i) {
  return block.at(i % 4, i / 4);
}

// A block of BC1 in which texel i has code i mod 4.
std::string bc1_block(uint32_t first, uint32_t second) { return BlockWriter().put(first, 16).put(second, 16).put(0xe4e4e4e4, 32).bytes(8); }

TEST_F(BlockCodec, Bc1HasFourColors) {
  const Image<glm::u8vec4> block = codes_of(kBc1, 4, 4, bc1_block(0xf800, 0x001f));  // red, blue
  const std::array<glm::u8vec4, 4> expected = {{{255, 0, 0, 255}, {0, 0, 255, 255}, {170, 0, 85, 255}, {85, 0, 170, 255}}};
  for (int i = 0; i < 16; ++i) EXPECT_EQ(texel_of(block, i), expected[static_cast<std::size_t>(i % 4)]) << i;
}

TEST_F(BlockCodec, Bc1HasThreeColorsAndTransparentBlack) {
  const Image<glm::u8vec4> block = codes_of(kBc1, 4, 4, bc1_block(0x001f, 0xf800));
  const std::array<glm::u8vec4, 4> expected = {{{0, 0, 255, 255}, {255, 0, 0, 255}, {128, 0, 128, 255}, {0, 0, 0, 0}}};
  for (int i = 0; i < 16; ++i) EXPECT_EQ(texel_of(block, i), expected[static_cast<std::size_t>(i % 4)]) << i;
}

TEST_F(BlockCodec, Bc1WithoutAlphaHasOpaqueBlack) {
  const std::string file = ktx2({.format = kVkBc1Opaque, .width = 4, .height = 4}, bc1_block(0x001f, 0xf800));
  const Image<glm::u8vec4> block = read_image(bytes_of(file), "opaque");
  EXPECT_EQ(texel_of(block, 2), glm::u8vec4(128, 0, 128, 255));
  EXPECT_EQ(texel_of(block, 3), glm::u8vec4(0, 0, 0, 255));
}

// Returns the byte nearest to 255 times a fraction. No fraction of 5-bit and 6-bit codes is half way between bytes.
int byte_of(int numerator, int denominator) { return static_cast<int>(std::lround(255.0 * numerator / denominator)); }

// All pairs of 5-bit codes in red and blue, and as many pairs of 6-bit codes in green.
TEST_F(BlockCodec, Bc3BlendsAllPairsOfCodes) {
  std::string blocks;
  for (uint32_t a = 0; a < 64; ++a) {
    for (uint32_t b = 0; b < 64; ++b) {
      const uint32_t first = a / 2 << 11 | a << 5 | a / 2, second = b / 2 << 11 | b << 5 | b / 2;
      blocks += std::string(8, '\0') + bc1_block(first, second);
    }
  }
  const Image<glm::u8vec4> image = codes_of(kBc3, 256, 256, blocks);
  constexpr std::array<int, 4> kFirst = {3, 0, 2, 1};
  for (int a = 0; a < 64; ++a) {
    for (int b = 0; b < 64; ++b) {
      for (int code = 0; code < 4; ++code) {
        const int w = kFirst[static_cast<std::size_t>(code)];
        const int red = byte_of(w * (a / 2) + (3 - w) * (b / 2), 93), green = byte_of(w * a + (3 - w) * b, 189);
        ASSERT_EQ(image.at(4 * b + code, 4 * a), glm::u8vec4(red, green, red, 0)) << a << " " << b << " " << code;
      }
    }
  }
}

TEST_F(BlockCodec, Bc2StoresAlphaOfFourBits) {
  BlockWriter alphas;
  for (uint64_t i = 0; i < 16; ++i) alphas.put(i, 4);
  const Image<glm::u8vec4> block = codes_of(kBc2, 4, 4, alphas.bytes(8) + bc1_block(0x001f, 0xf800));
  for (int i = 0; i < 16; ++i) EXPECT_EQ(texel_of(block, i).w, 17 * i);
  EXPECT_EQ(texel_of(block, 2), glm::u8vec4(85, 0, 170, 34)) << "always has four colors";
  EXPECT_EQ(texel_of(block, 3), glm::u8vec4(170, 0, 85, 51));
}

// A block of BC4 in which texel i has code i mod 8.
std::string bc4_block(int first, int second) {
  BlockWriter block;
  block.put(static_cast<uint8_t>(first), 8).put(static_cast<uint8_t>(second), 8);
  for (uint64_t i = 0; i < 16; ++i) block.put(i % 8, 3);
  return block.bytes(8);
}

// Returns the value for a code, in units of the codes of the endpoints.
double bc4_value(int first, int second, int code, int min, int max) {
  if (code < 2) return code == 0 ? first : second;
  if (first > second) return ((8 - code) * first + (code - 1) * second) / 7.0;
  return code == 6 ? min : code == 7 ? max : ((6 - code) * first + (code - 1) * second) / 5.0;
}

std::string all_bc4_blocks() {
  std::string blocks;
  for (int a = 0; a < 256; ++a) {
    for (int b = 0; b < 256; ++b) blocks += bc4_block(a, b);
  }
  return blocks;
}

TEST_F(BlockCodec, Bc4HasAllValuesOfAllPairs) {
  const Image<float> image = numbers_of(kBc4, 1024, 1024, all_bc4_blocks());
  for (int a = 0; a < 256; ++a) {
    for (int b = 0; b < 256; ++b) {
      for (int code = 0; code < 8; ++code) {
        const double exact = bc4_value(a, b, code, 0, 255) / 255.0;
        ASSERT_EQ(image.at(4 * b + code % 4, 4 * a + code / 4), static_cast<float>(std::lround(65535.0 * exact)) / 65535.0f)
            << a << " " << b << " " << code;
      }
    }
  }
}

TEST_F(BlockCodec, SignedBc4HasAllValuesOfAllPairs) {
  const Image<float> image = numbers_of(kBc4Signed, 1024, 1024, all_bc4_blocks());
  const auto number = [](int code) { return std::max<int>(static_cast<int8_t>(code), -127); };
  for (int a = 0; a < 256; ++a) {
    for (int b = 0; b < 256; ++b) {
      for (int code = 0; code < 8; ++code) {
        const double exact = bc4_value(number(a), number(b), code, -127, 127) / 127.0;
        ASSERT_NEAR(image.at(4 * b + code % 4, 4 * a + code / 4), exact, 6e-8) << a << " " << b << " " << code;
      }
    }
  }
  EXPECT_EQ(image.at(1, 4 * 127), 0.0f);
  EXPECT_EQ(image.at(0, 4 * 127), 1.0f);
  EXPECT_EQ(image.at(0, 4 * 128), -1.0f);
}

TEST_F(BlockCodec, Bc3AlphaIsTheNearestByte) {
  for (const auto& [a, b] : {std::pair(200, 60), std::pair(60, 200)}) {
    const Image<glm::u8vec4> block = codes_of(kBc3, 4, 4, bc4_block(a, b) + bc1_block(0, 0));
    for (int i = 0; i < 16; ++i) EXPECT_EQ(texel_of(block, i).w, std::lround(bc4_value(a, b, i % 8, 0, 255))) << a << " " << i;
  }
}

TEST_F(BlockCodec, Bc5HasRedAndGreen) {
  const std::string blocks = bc4_block(210, 0) + bc4_block(0, 255);
  const Image<glm::u8vec4> block = codes_of(kBc5, 4, 4, blocks);
  for (int i = 0; i < 16; ++i) {
    const auto red = std::lround(bc4_value(210, 0, i % 8, 0, 255)), green = std::lround(bc4_value(0, 255, i % 8, 0, 255));
    EXPECT_EQ(texel_of(block, i), glm::u8vec4(red, green, 0, 255)) << i;
  }
}

TEST_F(BlockCodec, SignedBc5HasRedAndGreen) {
  const Image<glm::vec4> block = colors_of(kBc5Signed, 4, 4, bc4_block(127, -127) + bc4_block(-128, 0));
  for (int i = 0; i < 16; ++i) {
    const glm::vec4 texel = texel_of(block, i);
    EXPECT_NEAR(texel.x, bc4_value(127, -127, i % 8, -127, 127) / 127.0, 6e-8) << i;
    EXPECT_NEAR(texel.y, bc4_value(-127, 0, i % 8, -127, 127) / 127.0, 6e-8) << i;
    EXPECT_EQ(texel.z, 0.0f);
    EXPECT_EQ(texel.w, 1.0f);
  }
}

// The parameters of a BC7 mode.
struct Bc7Mode {
  int subsets, partition_bits, extra_bits, color_bits, alpha_bits, low_bits;  // extra: rotation and index selection; low: in all
  int index_bits, second_index_bits;
};
constexpr std::array<Bc7Mode, 8> kBc7Modes = {{{3, 4, 0, 4, 0, 6, 3, 0},
                                               {2, 6, 0, 6, 0, 2, 3, 0},
                                               {3, 6, 0, 5, 0, 0, 2, 0},
                                               {2, 6, 0, 7, 0, 4, 2, 0},
                                               {1, 0, 3, 5, 6, 0, 2, 3},
                                               {1, 0, 2, 7, 8, 0, 2, 2},
                                               {1, 0, 0, 7, 7, 2, 4, 0},
                                               {2, 6, 0, 5, 5, 4, 2, 0}}};

// Writes the fields of a block up to the indices. color(endpoint, channel) returns the bits of an endpoint.
template <class Color>
BlockWriter bc7_start(std::size_t number, uint64_t partition, uint64_t extra, uint64_t low, Color&& color) {
  const Bc7Mode& mode = kBc7Modes[number];
  BlockWriter block;
  block.put(uint64_t{1} << number, static_cast<int>(number) + 1).put(partition, mode.partition_bits).put(extra, mode.extra_bits);
  for (int c = 0; c < 4; ++c) {
    for (int e = 0; e < 2 * mode.subsets; ++e) block.put(color(e, c), c == 3 ? mode.alpha_bits : mode.color_bits);
  }
  return block.put(low, mode.low_bits);
}

int index_space(const Bc7Mode& mode, int index_bits) { return index_bits == 0 ? 0 : 16 * index_bits - mode.subsets; }

// In each mode and partition, subset s has the color of both of its endpoints, whatever the indices are.
TEST_F(BlockCodec, Bc7DividesBlocksInEachMode) {
  for (std::size_t number = 0; number < 8; ++number) {
    const Bc7Mode& mode = kBc7Modes[number];
    const int partitions = 1 << mode.partition_bits;
    std::string blocks;
    for (int p = 0; p < partitions; ++p) {
      // The highest bit of a color tells subset 1, and that of green subset 2. All lower bits are 0.
      BlockWriter block = bc7_start(number, static_cast<uint64_t>(p), 0, 0, [&](int e, int c) -> uint64_t {
        const int bits = c == 3 ? mode.alpha_bits : mode.color_bits;
        return c == 3 || (c == 0 && e / 2 == 1) || (c == 1 && e / 2 == 2) ? uint64_t{1} << bits >> 1 : 0;
      });
      const int space = index_space(mode, mode.index_bits) + index_space(mode, mode.second_index_bits);
      for (int i = 0; i < space; ++i) block.put(static_cast<uint64_t>(i % 3 == 0), 1);
      blocks += block.bytes(16);
    }
    const Image<glm::u8vec4> image = codes_of(kBc7, static_cast<uint32_t>(4 * partitions), 4, blocks);
    // The highest bit is repeated below the stored bits.
    const auto high = [](int bits, int low) { return bits == 0 ? 255 : 128 | (bits + low < 8 ? 128 >> (bits + low) : 0); };
    const bool has_low = mode.low_bits != 0;
    const int on = high(mode.color_bits, has_low ? 1 : 0), alpha = high(mode.alpha_bits, has_low ? 1 : 0);
    std::set<std::vector<int>> patterns;
    for (int p = 0; p < partitions; ++p) {
      std::vector<int> pattern;
      for (int i = 0; i < 16; ++i) {
        const glm::u8vec4 texel = image.at(4 * p + i % 4, i / 4);
        pattern.push_back(texel.x == on ? 1 : texel.y == on ? 2 : 0);
        ASSERT_TRUE((texel.x == 0 || texel.x == on) && (texel.y == 0 || texel.y == on) && texel.z == 0 && texel.w == alpha)
            << number << " " << p;
      }
      EXPECT_EQ(pattern[0], 0) << "mode " << number << ", partition " << p;
      EXPECT_EQ(std::set<int>(pattern.begin(), pattern.end()).size(), static_cast<std::size_t>(mode.subsets)) << number << " " << p;
      patterns.insert(pattern);
    }
    EXPECT_EQ(patterns.size(), static_cast<std::size_t>(partitions)) << "mode " << number;
  }
}

// With all stored bits of the indices 1, the anchor of each subset has the index below the middle, and all other texels the highest one.
TEST_F(BlockCodec, Bc7HasOneAnchorPerSubset) {
  constexpr std::array<int, 5> kBelowMiddle = {0, 0, 84, 108, 120};  // (255·w + 32)/64 for the weights 21, 27 and 30
  for (const std::size_t number : {1u, 2u, 3u, 6u}) {
    const Bc7Mode& mode = kBc7Modes[number];
    for (int p = 0; p < 1 << mode.partition_bits; ++p) {
      BlockWriter block = bc7_start(number, static_cast<uint64_t>(p), 0, number == 1 ? 0 : 0xa, [&](int e, int c) -> uint64_t {
        return c == 3 || e % 2 == 1 ? (uint64_t{1} << mode.color_bits) - 1 : 0;
      });
      block.put(~uint64_t{0}, index_space(mode, mode.index_bits));
      const Image<glm::u8vec4> image = codes_of(kBc7, 4, 4, block.bytes(16));
      int anchors = 0;
      for (int i = 0; i < 16; ++i) anchors += texel_of(image, i).x < 128 ? 1 : 0;
      ASSERT_EQ(anchors, mode.subsets) << number << " " << p;
      EXPECT_NEAR(texel_of(image, 0).x, kBelowMiddle[static_cast<std::size_t>(mode.index_bits)], number == 1 ? 3 : 0);
    }
  }
}

// Modes 4 to 6: texel i has index i, or i mod 4 or 8. The endpoints are 0 and 255.
TEST_F(BlockCodec, Bc7InterpolatesWithSixBitWeights) {
  constexpr std::array<int, 4> kTwoBits = {0, 84, 171, 255};
  constexpr std::array<int, 8> kThreeBits = {0, 36, 72, 108, 147, 183, 219, 255};
  constexpr std::array<uint8_t, 16> kFourBits = {0, 16, 36, 52, 68, 84, 104, 120, 135, 151, 171, 187, 203, 219, 239, 255};
  const auto ends = [](int e, int) { return e == 1 ? ~uint64_t{0} : 0; };
  const auto put_indices = [](BlockWriter& block, int bits) {
    for (uint64_t i = 0; i < 16; ++i) block.put(i % (uint64_t{1} << bits), bits - (i == 0 ? 1 : 0));
  };
  BlockWriter six = bc7_start(6, 0, 0, 2, ends);  // the low bits of the endpoints are 0 and 1
  put_indices(six, 4);
  const Image<glm::u8vec4> one = codes_of(kBc7, 4, 4, six.bytes(16));
  for (int i = 0; i < 16; ++i) EXPECT_EQ(texel_of(one, i), glm::u8vec4(kFourBits[static_cast<std::size_t>(i)])) << i;
  for (const uint64_t exchanged : {0u, 1u}) {
    BlockWriter four = bc7_start(4, 0, exchanged << 2, 0, ends);
    put_indices(four, 2);
    put_indices(four, 3);
    const Image<glm::u8vec4> two = codes_of(kBc7, 4, 4, four.bytes(16));
    for (int i = 0; i < 16; ++i) {
      const int first = kTwoBits[static_cast<std::size_t>(i % 4)], second = kThreeBits[static_cast<std::size_t>(i % 8)];
      EXPECT_EQ(texel_of(two, i).x, exchanged != 0 ? second : first) << i;
      EXPECT_EQ(texel_of(two, i).w, exchanged != 0 ? first : second) << i;
    }
  }
}

TEST_F(BlockCodec, Bc7RotatesChannels) {
  constexpr std::array<uint64_t, 4> kCodes = {1, 2, 3, 200};  // 7-bit colors and 8-bit alpha
  const std::array<glm::u8vec4, 4> expected = {{{2, 4, 6, 200}, {200, 4, 6, 2}, {2, 200, 6, 4}, {2, 4, 200, 6}}};
  for (uint64_t rotation = 0; rotation < 4; ++rotation) {
    const BlockWriter block = bc7_start(5, 0, rotation, 0, [&](int, int c) { return kCodes[static_cast<std::size_t>(c)]; });
    EXPECT_EQ(codes_of(kBc7, 4, 4, block.bytes(16)).at(3, 3), expected[rotation]) << rotation;
  }
}

TEST_F(BlockCodec, ReservedModesAreZero) {
  EXPECT_EQ(codes_of(kBc7, 4, 4, std::string(16, '\0')).at(1, 2), glm::u8vec4(0));
  for (const char* mode : {"\x13", "\x17", "\x1b", "\x1f"}) {
    const std::string block = mode + std::string(15, '\xff');
    EXPECT_EQ(colors_of(kBc6h, 4, 4, block).at(1, 2), glm::vec4(0, 0, 0, 1)) << int{mode[0]};
  }
}

// A BC6H mode: its number, the bits of endpoint 0, and where the bits of its channels from 10 on are in a block.
struct Bc6hMode {
  uint64_t number;
  int bits;
  bool has_two_subsets, is_transformed;
  std::array<std::vector<int>, 3> high;
};
const std::array<Bc6hMode, 14> kBc6hModes = {{
    {0, 10, true, true, {}},
    {1, 7, true, true, {}},
    {2, 11, true, true, {{{40}, {49}, {59}}}},
    {6, 11, true, true, {{{39}, {50}, {59}}}},
    {10, 11, true, true, {{{39}, {49}, {60}}}},
    {14, 9, true, true, {}},
    {18, 8, true, true, {}},
    {22, 8, true, true, {}},
    {26, 8, true, true, {}},
    {30, 6, true, false, {}},
    {3, 10, false, false, {}},
    {7, 11, false, true, {{{44}, {54}, {64}}}},
    {11, 12, false, true, {{{44, 43}, {54, 53}, {64, 63}}}},
    {15, 16, false, true, {{{44, 43, 42, 41, 40, 39}, {54, 53, 52, 51, 50, 49}, {64, 63, 62, 61, 60, 59}}}},
}};

// Writes endpoint 0, and the lowest 4 bits of endpoint 1 of each channel. All other bits are 0.
BlockWriter bc6h_block(const Bc6hMode& mode, const std::array<uint32_t, 3>& base, const std::array<uint32_t, 3>& second) {
  BlockWriter block;
  block.put(mode.number, 5).put(0, 123);
  for (std::size_t c = 0; c < 3; ++c) {
    const int first = 10 * static_cast<int>(c);
    for (int i = 0; i < std::min(mode.bits, 10); ++i) block.set(5 + first + i, (base[c] >> i & 1) != 0);
    for (std::size_t i = 0; i < mode.high[c].size(); ++i) block.set(mode.high[c][i], (base[c] >> (10 + i) & 1) != 0);
    for (int i = 0; i < 4; ++i) block.set(35 + first + i, (second[c] >> i & 1) != 0);
  }
  return block;
}

// Returns the value of an endpoint: the specification's unquantization and final scale.
float bc6h_number(int x, int bits, bool is_signed) {
  const int magnitude = std::abs(x), width = is_signed ? bits - 1 : bits, max = (1 << width) - 1;
  int wide = is_signed ? 0x7fff : 0xffff;
  if (bits >= 15 || magnitude == 0) {
    wide = magnitude;
  } else if (magnitude < max) {
    wide = ((magnitude << 15) + 0x4000) >> (bits - 1);
  }
  const int half = is_signed ? wide * 31 / 32 : wide * 31 / 64;
  return std::copysign(half_to_float(static_cast<uint16_t>(half)), x < 0 ? -1.0f : 1.0f);
}

// Endpoint 0 in each mode, for many numbers. The other endpoints are the same or, in modes without differences, 0; all indices are 0.
TEST_F(BlockCodec, Bc6hDecodesTheFirstEndpointInEachMode) {
  for (const bool is_signed : {false, true}) {
    for (const Bc6hMode& mode : kBc6hModes) {
      const auto codes = uint32_t{1} << mode.bits;
      std::string blocks;
      std::vector<std::array<uint32_t, 3>> bases;
      for (uint32_t i = 0; i < 64; ++i) {
        const uint32_t code = i * (codes / 64) + (i % 2) * (codes / 64 - 1);
        bases.push_back({code, codes - 1 - code, (code * 7 + 1) % codes});
        blocks += bc6h_block(mode, bases.back(), {}).bytes(16);
      }
      const Image<glm::vec4> image = colors_of(is_signed ? kBc6hSigned : kBc6h, 256, 4, blocks);
      for (std::size_t i = 0; i < bases.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
          const auto code = static_cast<int>(bases[i][static_cast<std::size_t>(c)]);
          const int x = is_signed && code >= static_cast<int>(codes / 2) ? code - static_cast<int>(codes) : code;
          const float expected = std::max(bc6h_number(x, mode.bits, is_signed), -65504.0f);  // −∞ is clamped by read_linear()
          ASSERT_EQ(image.at(4 * static_cast<int>(i), 0)[c], expected) << mode.number << " " << is_signed << " " << code << " " << c;
        }
        ASSERT_EQ(image.at(4 * static_cast<int>(i), 0).w, 1.0f);
      }
    }
  }
}

// In modes with differences, endpoint 1 is endpoint 0 plus a number. Texel 1 of partition 13, or of a block with one subset, belongs to
// subset 0 and has the highest index.
TEST_F(BlockCodec, Bc6hAddsDifferences) {
  constexpr uint64_t kUpperHalf = 13;
  for (const Bc6hMode& mode : kBc6hModes) {
    if (!mode.is_transformed) continue;
    const uint32_t base = uint32_t{5} << (mode.bits - 4);
    BlockWriter block = bc6h_block(mode, {base, base + 1, base + 2}, {3, 5, 7});
    if (mode.has_two_subsets) {
      for (int i = 0; i < 5; ++i) block.set(77 + i, (kUpperHalf >> i & 1) != 0);
      for (int i = 0; i < 3; ++i) block.set(84 + i, true);
    } else {
      for (int i = 0; i < 4; ++i) block.set(68 + i, true);
    }
    for (const bool is_signed : {false, true}) {
      const glm::vec4 texel = colors_of(is_signed ? kBc6hSigned : kBc6h, 4, 4, block.bytes(16)).at(1, 0);
      for (int c = 0; c < 3; ++c) {
        const auto x = static_cast<int>(base) + c + (2 * c + 3);
        EXPECT_EQ(texel[c], bc6h_number(x, mode.bits, is_signed)) << mode.number << " " << is_signed << " " << c;
      }
    }
  }
}

// Mode 3: 10-bit endpoints 0 and 1023, and texel i has index i.
TEST_F(BlockCodec, Bc6hInterpolatesBitsOfHalfs) {
  constexpr std::array<int, 16> kWeights = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
  BlockWriter block;
  block.put(3, 5).put(0, 30).put(0x3fffffff, 30);
  for (uint64_t i = 0; i < 16; ++i) block.put(i, i == 0 ? 3 : 4);
  const Image<glm::vec4> image = colors_of(kBc6h, 4, 4, block.bytes(16));
  for (int i = 0; i < 16; ++i) {
    const int wide = (kWeights[static_cast<std::size_t>(i)] * 0xffff + 32) / 64;
    EXPECT_EQ(texel_of(image, i), glm::vec4(glm::vec3(half_to_float(static_cast<uint16_t>(wide * 31 / 64))), 1.0f)) << i;
  }
  EXPECT_EQ(texel_of(image, 15).x, 65504.0f);
}

// Texels of 4096 blocks with random bits. When the hashes were recorded, all numbers were equal to those of OpenImageIO 2.4.
TEST_F(BlockCodec, RandomBlocksOfBptcAreUnchanged) {
  const auto hash_of = [](const auto& image) {
    uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
    for (const std::byte b : std::as_bytes(image.texels())) hash = (hash ^ std::to_integer<uint64_t>(b)) * 0x100000001b3;
    return hash;
  };
  std::string blocks;
  uint32_t state = 1;
  for (int i = 0; i < 4096 * 16; ++i) {
    state = state * 1664525 + 1013904223;
    blocks += static_cast<char>(state >> 24);
  }
  EXPECT_EQ(hash_of(colors_of(kBc6h, 256, 256, blocks)), 945976904205120185u);
  EXPECT_EQ(hash_of(colors_of(kBc6hSigned, 256, 256, blocks)), 10038033262865792551u);
  for (std::size_t i = 0; i < blocks.size(); i += 16) {  // all modes of BC7 alike
    const int mode = static_cast<int>(i / 16 % 8);
    const int byte = static_cast<unsigned char>(blocks[i]);
    blocks[i] = static_cast<char>((byte >> (mode + 1) << (mode + 1)) | 1 << mode);
  }
  EXPECT_EQ(hash_of(codes_of(kBc7, 256, 256, blocks)), 10788261232939927416u);
}

TEST_F(BlockCodec, PartialBlocksAreCut) {
  const Image<glm::u8vec4> image = codes_of(kBc1, 5, 3, bc1_block(0xf800, 0x001f) + bc1_block(0x001f, 0xf800));
  ASSERT_EQ(image.width(), 5);
  ASSERT_EQ(image.height(), 3);
  EXPECT_EQ(image.at(3, 2), glm::u8vec4(85, 0, 170, 255));
  EXPECT_EQ(image.at(4, 2), glm::u8vec4(0, 0, 255, 255));
}

}  // namespace
}  // namespace halfspace::block_codec_test
