// SPDX-License-Identifier: Apache-2.0
//
// Tests the integer and packing functions of the shading language against loops over bits, 64-bit products and the formulas of GLSL, and
// that lanes return the bits of scalars.
#include "halfspace/core/glsl_integer.h"

#include <bit>

#include "core/glsl_lanes.h"
#include "halfspace/core/glsl_packing.h"

namespace halfspace {
namespace {

std::vector<uint32_t> integers_to_test() {
  std::vector<uint32_t> v = {0, 1, 2, 3, 0x7fffffff, 0x80000000, 0x80000001, 0xfffffffe, 0xffffffff, 0xaaaaaaaa, 0x00ff00ff};
  for (int n = 0; n < 32; ++n) v.push_back(1u << n);
  std::mt19937 random(10);
  for (int i = 0; i < 300; ++i) v.push_back(static_cast<uint32_t>(random()) >> (random() % 32));
  return v;
}

TEST(GlslInteger, BitFunctionsMatchLoopsOverBits) {
  for (const uint32_t u : integers_to_test()) {
    const auto i = static_cast<int32_t>(u);
    uint32_t reversed = 0;
    for (int n = 0; n < 32; ++n) reversed |= (u >> n & 1) << (31 - n);
    EXPECT_EQ(bitfieldReverse(u), reversed);
    EXPECT_EQ(bitfieldReverse(i), static_cast<int32_t>(reversed));
    EXPECT_EQ(bitCount(u), std::popcount(u));
    EXPECT_EQ(bitCount(i), std::popcount(u));
    EXPECT_EQ(findLSB(u), u == 0 ? -1 : std::countr_zero(u));
    EXPECT_EQ(findLSB(i), findLSB(u));
    EXPECT_EQ(findMSB(u), 31 - std::countl_zero(u));
    EXPECT_EQ(findMSB(i), i < 0 ? 31 - std::countl_zero(~u) : 31 - std::countl_zero(u));
  }
}

TEST(GlslInteger, BitfieldsAreExtractedAndInserted) {
  for (const uint32_t u : integers_to_test()) {
    for (int offset = 0; offset <= 32; ++offset) {
      for (int bits = 0; offset + bits <= 32; ++bits) {
        const uint64_t mask = (uint64_t{1} << bits) - 1;
        const auto field = static_cast<uint32_t>(uint64_t{u} >> offset & mask);
        ASSERT_EQ(bitfieldExtract(u, offset, bits), field) << u << ' ' << offset << ' ' << bits;
        const bool negative = bits > 0 && (field >> (bits - 1) & 1) != 0;
        const auto extended = static_cast<int32_t>(negative ? field | ~static_cast<uint32_t>(mask) : field);
        ASSERT_EQ(bitfieldExtract(static_cast<int32_t>(u), offset, bits), extended) << u << ' ' << offset << ' ' << bits;
        const uint32_t base = 0x5a3c96e1;
        const auto inserted = static_cast<uint32_t>((base & ~(mask << offset)) | (u & mask) << offset);
        ASSERT_EQ(bitfieldInsert(base, u, offset, bits), inserted) << u << ' ' << offset << ' ' << bits;
        ASSERT_EQ(bitfieldInsert(static_cast<int32_t>(base), static_cast<int32_t>(u), offset, bits), static_cast<int32_t>(inserted));
      }
    }
  }
}

TEST(GlslInteger, ExtendedArithmeticMatches64Bits) {
  const auto values = integers_to_test();
  for (const uint32_t x : values) {
    for (const uint32_t y : values) {
      uint32_t carry = 9, borrow = 9, msb = 9, lsb = 9;
      ASSERT_EQ(uaddCarry(x, y, carry), x + y);
      ASSERT_EQ(carry, (uint64_t{x} + y) >> 32);
      ASSERT_EQ(usubBorrow(x, y, borrow), x - y);
      ASSERT_EQ(borrow, x < y ? 1u : 0u);
      umulExtended(x, y, msb, lsb);
      ASSERT_EQ(uint64_t{msb} << 32 | lsb, uint64_t{x} * y);
      int32_t high = 9, low = 9;
      imulExtended(static_cast<int32_t>(x), static_cast<int32_t>(y), high, low);
      const int64_t product = int64_t{static_cast<int32_t>(x)} * static_cast<int32_t>(y);
      ASSERT_EQ(static_cast<uint64_t>(product), uint64_t{static_cast<uint32_t>(high)} << 32 | static_cast<uint32_t>(low)) << x << ' ' << y;
    }
  }
}

TEST(GlslInteger, OutputsMayBeInputs) {
  constexpr uint32_t x = 0xfffffff1u, y = 0x87654321u;
  uint32_t a = x, low = 0;
  umulExtended(a, y, a, low);
  EXPECT_EQ(uint64_t{a} << 32 | low, uint64_t{x} * y);
  uint32_t b = y, high = 0;
  umulExtended(x, b, high, b);
  EXPECT_EQ(uint64_t{high} << 32 | b, uint64_t{x} * y);
  int32_t i = -5, other = 0;
  imulExtended(i, 7, i, other);
  EXPECT_EQ(i, -1);
  EXPECT_EQ(other, -35);
  uint32_t c = x;
  EXPECT_EQ(uaddCarry(c, y, c), x + y);
  EXPECT_EQ(c, 1u);
  c = y;
  EXPECT_EQ(uaddCarry(5u, c, c), y + 5);
  EXPECT_EQ(c, 0u);
  c = x;
  EXPECT_EQ(usubBorrow(y, c, c), y - x);
  EXPECT_EQ(c, 1u);
  uvec2<float> v(x, 3);
  EXPECT_TRUE(uaddCarry(uvec2<float>(y, 4), v, v) == uvec2<float>(x + y, 7));
  EXPECT_TRUE(v == uvec2<float>(1, 0));
}

TEST(GlslInteger, UnspecifiedPlacesOfBitfieldsAreSafe) {  // without overflow, as the sanitizers check
  constexpr int32_t kLow = std::numeric_limits<int32_t>::min(), kHigh = std::numeric_limits<int32_t>::max();
  for (const int32_t offset : {kLow, -1, 31, 33, kHigh}) {
    for (const int32_t bits : {kLow, -1, 32, 33, kHigh}) {
      const int32_t lanes = lane(bitfieldExtract(IntN<4>(-9), IntN<4>(offset), IntN<4>(bits)), 1);
      EXPECT_EQ(bitfieldExtract(-9, offset, bits), lanes) << offset << ' ' << bits;
      EXPECT_EQ(bitfieldExtract(9u, offset, bits), lane(bitfieldExtract(UintOf<RealN<4>>(9u), IntN<4>(offset), IntN<4>(bits)), 1));
      EXPECT_EQ(bitfieldInsert(-9, 5, offset, bits), lane(bitfieldInsert(IntN<4>(-9), IntN<4>(5), IntN<4>(offset), IntN<4>(bits)), 1));
    }
  }
}

TEST(GlslInteger, LanesMatchScalarBits) {
  expect_glsl_lanes_match_scalars([](const auto& a, auto& out) {
    const auto i = a.i3(0), j = a.i3(3);
    const auto u = a.u3(0), w = a.u3(3);
    const auto offset = a.i[6] & 31, bits = a.i[7] & (31 - offset);  // offset + bits <= 31
    out.add(bitfieldExtract(i, offset, bits)), out.add(bitfieldExtract(u, offset, bits)), out.add(bitfieldExtract(u, 3, 29));
    out.add(bitfieldInsert(i, j, offset, bits)), out.add(bitfieldInsert(u, w, offset, bits)), out.add(bitfieldInsert(u, w, 0, 32));
    out.add(bitfieldReverse(i)), out.add(bitfieldReverse(u)), out.add(bitCount(i)), out.add(bitCount(u)), out.add(findLSB(i));
    out.add(findLSB(u)), out.add(findMSB(i)), out.add(findMSB(u)), out.add(bitCount(a.i[0])), out.add(findMSB(a.u(1)));
    auto c = u, d = u;
    out.add(uaddCarry(u, w, c)), out.add(c), out.add(usubBorrow(u, w, d)), out.add(d);
    umulExtended(u, w, c, d), out.add(c), out.add(d);
    auto p = i, q = i;
    imulExtended(i, j, p, q), out.add(p), out.add(q);
    auto x = a.u(0), y = x;
    umulExtended(a.u(1), a.u(2), x, y), out.add(x), out.add(y);
    out.add(bitfieldExtract(a.i[0], offset, bits)), out.add(bitfieldExtract(a.u(0), 5, 7));
  });
}

// ---- packing ---------------------------------------------------------------------------------------------------

TEST(GlslPacking, UnpackedCodesAreCorrectlyRoundedAndPackedAgain) {
  for (uint32_t code = 0; code < 65536; ++code) {
    const uint32_t both = code | (65535 - code) << 16;
    const vec2<float> unorm = unpackUnorm2x16(both), snorm = unpackSnorm2x16(both), half = unpackHalf2x16(both);
    ASSERT_EQ(unorm.x, static_cast<float>(code / 65535.0));
    ASSERT_EQ(packUnorm2x16(unorm), both);
    ASSERT_EQ(snorm.x, static_cast<float>(std::max(static_cast<int16_t>(code) / 32767.0, -1.0)));
    ASSERT_TRUE(packSnorm2x16(snorm) == both || code == 0x8000 || code == 0x7fff) << code;  // −32768 has no number of its own
    ASSERT_TRUE(same_bits(half.x, half_to_float(static_cast<uint16_t>(code))) &&
                same_bits(half.y, half_to_float(static_cast<uint16_t>(65535 - code))));
    ASSERT_TRUE(std::isnan(half.x) || std::isnan(half.y) || packHalf2x16(half) == both) << code;
  }
  for (uint32_t code = 0; code < 256; ++code) {
    const uint32_t four = code | (255 - code) << 8 | (code ^ 0x55) << 16 | (code ^ 0xf0) << 24;
    const vec4<float> unorm = unpackUnorm4x8(four), snorm = unpackSnorm4x8(four);
    EXPECT_EQ(unorm.w, static_cast<float>((code ^ 0xf0) / 255.0));
    EXPECT_EQ(packUnorm4x8(unorm), four);
    EXPECT_EQ(snorm.y, static_cast<float>(std::max(static_cast<int8_t>(255 - code) / 127.0, -1.0)));
    const uint32_t again = packSnorm4x8(snorm);
    for (int n = 0; n < 32; n += 8) EXPECT_TRUE((four >> n & 255) == 0x80 || (again >> n & 255) == (four >> n & 255));
  }
  EXPECT_EQ(packSnorm4x8(unpackSnorm4x8(0x80808080u)), 0x81818181u);
}

TEST(GlslPacking, PackedNumbersAreClampedAndRounded) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> wide(-1.5f, 1.5f);
  for (int i = 0; i < 100000; ++i) {
    const float x = wide(random), y = wide(random);
    const auto code = [](float value, float low, float scale, uint32_t mask) {
      return static_cast<uint32_t>(static_cast<int32_t>(std::nearbyint(std::min(std::max(value, low), 1.0f) * scale))) & mask;
    };
    ASSERT_EQ(packUnorm2x16(vec2<float>(x, y)), code(x, 0, 65535, 0xffff) | code(y, 0, 65535, 0xffff) << 16);
    ASSERT_EQ(packSnorm2x16(vec2<float>(x, y)), code(x, -1, 32767, 0xffff) | code(y, -1, 32767, 0xffff) << 16);
    ASSERT_EQ(packUnorm4x8(vec4<float>(x, y, y, x)), code(x, 0, 255, 255) * 0x01000001u | code(y, 0, 255, 255) * 0x00010100u);
    ASSERT_EQ(packSnorm4x8(vec4<float>(x, y, y, x)), code(x, -1, 127, 255) * 0x01000001u | code(y, -1, 127, 255) * 0x00010100u);
  }
  EXPECT_EQ(packUnorm2x16(vec2<float>(kNaN, kInf)), 0xffff0000u);
  EXPECT_EQ(packHalf2x16(vec2<float>(1.0f, -kInf)), 0xfc003c00u);
}

TEST(GlslPacking, LanesMatchScalarBits) {
  expect_glsl_lanes_match_scalars([](const auto& a, auto& out) {
    out.add(packUnorm2x16(a.v2(0))), out.add(packSnorm2x16(a.v2(0))), out.add(packUnorm4x8(a.v4(0))), out.add(packSnorm4x8(a.v4(0)));
    out.add(packHalf2x16(a.v2(0))), out.add(unpackUnorm2x16(a.u(0))), out.add(unpackSnorm2x16(a.u(1))), out.add(unpackUnorm4x8(a.u(2)));
    out.add(unpackSnorm4x8(a.u(3))), out.add(unpackHalf2x16(a.u(4))), out.add(floatBitsToInt(a.x[0])), out.add(floatBitsToUint(a.x[1]));
    out.add(floatBitsToInt(a.v3(0))), out.add(floatBitsToUint(a.v3(0))), out.add(intBitsToFloat(a.i3(0))),
        out.add(uintBitsToFloat(a.u3(0)));
    out.add(intBitsToFloat(a.i[0])), out.add(uintBitsToFloat(a.u(0)));
  });
}

}  // namespace
}  // namespace halfspace
