// SPDX-License-Identifier: Apache-2.0
//
// Texel formats: every code of each channel type against its definition in double, rounding at the middle between two codes, and the same
// results for lanes, single values and memory.
#include "halfspace/core/texel_codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <string_view>
#include <vector>

namespace halfspace::texel_codec {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kMax = std::numeric_limits<float>::max();

// Values of increasing codes, and a function that encodes a value.
template <class Encode>
void expect_rounding(const std::vector<double>& values, int first_code, const Encode& encode) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int code = first_code + static_cast<int>(i);
    EXPECT_EQ(encode(static_cast<float>(values[i])), code);
    if (i + 1 == values.size()) continue;
    const double middle = 0.5 * (values[i] + values[i + 1]);
    const auto near = static_cast<float>(middle);
    // The floats next to the middle, of which one can be exactly there.
    for (const float x : {std::nextafter(near, -kInf), near, std::nextafter(near, kInf)}) {
      const int expected = static_cast<double>(x) < middle ? code : static_cast<double>(x) > middle ? code + 1 : code + (code & 1);
      EXPECT_EQ(encode(x), expected) << x;
    }
  }
}

TEST(TexelCodec, UnormCodesAreNearestQuotients) {
  for (const int bits : {1, 2, 8, 10, 16}) {
    const int max = (1 << bits) - 1;
    std::vector<double> values;
    for (int code = 0; code <= max; ++code) {
      values.push_back(static_cast<double>(code) / max);
      EXPECT_EQ(decode_unorm<float>(code, bits), static_cast<float>(values.back())) << bits << ' ' << code;
    }
    expect_rounding(values, 0, [&](float x) { return encode_unorm(x, bits); });
    for (const float x : {-kInf, -1.0f, -0.0f, kNan}) EXPECT_EQ(encode_unorm(x, bits), 0) << x;
    for (const float x : {1.0f, 2.0f, kMax, kInf}) EXPECT_EQ(encode_unorm(x, bits), max) << x;
  }
}

TEST(TexelCodec, SnormCodesAreNearestQuotients) {
  for (const int bits : {2, 8, 10, 16}) {
    const int max = (1 << (bits - 1)) - 1;
    std::vector<double> values;
    for (int code = -max; code <= max; ++code) {
      values.push_back(static_cast<double>(code) / max);
      EXPECT_EQ(decode_snorm<float>(code, bits), static_cast<float>(values.back())) << bits << ' ' << code;
    }
    EXPECT_EQ(decode_snorm<float>(-max - 1, bits), -1.0f);
    expect_rounding(values, -max, [&](float x) { return encode_snorm(x, bits); });
    for (const float x : {-kInf, -2.0f, -1.0f, kNan}) EXPECT_EQ(encode_snorm(x, bits), -max) << x;
    for (const float x : {1.0f, 2.0f, kInf}) EXPECT_EQ(encode_snorm(x, bits), max) << x;
  }
}

TEST(TexelCodec, SmallFloatsAreNearestValues) {
  for (const int mantissa : {5, 6}) {
    const int infinity = 31 << mantissa;
    std::vector<double> values;
    for (int code = 0; code < infinity; ++code) {
      const int exponent = code >> mantissa, fraction = code & ((1 << mantissa) - 1);
      values.push_back(exponent == 0 ? std::ldexp(fraction, -14 - mantissa)
                                     : std::ldexp((1 << mantissa) + fraction, exponent - 15 - mantissa));
      EXPECT_EQ(decode_small_float<float>(code, mantissa), static_cast<float>(values.back())) << code;
    }
    EXPECT_EQ(values.back(), mantissa == 6 ? 65024.0 : 64512.0);  // OpenGL 4.6, sections 2.3.4.3 and 2.3.4.4
    expect_rounding(values, 0, [&](float x) { return encode_small_float(x, mantissa); });
    EXPECT_EQ(decode_small_float<float>(infinity, mantissa), kInf);
    for (int code = infinity + 1; code < 32 << mantissa; ++code) EXPECT_TRUE(std::isnan(decode_small_float<float>(code, mantissa)));
    for (const float x : {-kInf, -1.0f, -0.0f}) EXPECT_EQ(encode_small_float(x, mantissa), 0) << x;
    for (const float x : {65536.0f, kMax}) EXPECT_EQ(encode_small_float(x, mantissa), infinity - 1) << x;
    EXPECT_EQ(encode_small_float(kInf, mantissa), infinity);
    for (const float x : {kNan, -kNan}) EXPECT_TRUE(std::isnan(decode_small_float<float>(encode_small_float(x, mantissa), mantissa)));
  }
}

// The algorithm of OpenGL 4.6, section 8.5.2, in double, which represents all of its values exactly.
uint32_t shared_exponent_by_definition(const glm::vec3& color) {
  glm::dvec3 c;
  for (int k = 0; k < 3; ++k) c[k] = std::isnan(color[k]) ? 0.0 : std::clamp(static_cast<double>(color[k]), 0.0, 511.0 / 512.0 * 65536.0);
  const double largest = std::max({c.x, c.y, c.z});
  const double log = largest == 0.0 ? -16.0 : std::floor(std::log2(largest));
  int exponent = static_cast<int>(std::max(-16.0, log)) + 16;
  if (std::floor(std::ldexp(largest, 24 - exponent) + 0.5) == 512.0) ++exponent;
  uint32_t word = static_cast<uint32_t>(exponent) << 27;
  for (int k = 0; k < 3; ++k) word |= static_cast<uint32_t>(std::floor(std::ldexp(c[k], 24 - exponent) + 0.5)) << (9 * k);
  return word;
}

TEST(TexelCodec, SharedExponentsFollowTheDefinition) {
  std::mt19937 random(1);
  const auto check = [](const glm::vec3& c) {
    EXPECT_EQ(static_cast<uint32_t>(encode_rgb9_e5(vec3<float>(c.x, c.y, c.z))), shared_exponent_by_definition(c))
        << c.x << ' ' << c.y << ' ' << c.z;
  };
  for (const float x : {0.0f, -1.0f, kNan, kInf, 65408.0f, 65407.9f, 1e-8f, 1e-30f, 0x1p-25f, 0x1.8p-25f, 0x1.ffep-16f, 0x1.ffcp-16f})
    for (const float y : {0.0f, 0.5f, 1.0f, x}) check({x, y, 0.25f * x});
  for (int i = 0; i < 200000; ++i) {
    const auto channel = [&] { return std::bit_cast<float>(static_cast<uint32_t>(random()) & 0x7fffffffu); };
    check({channel(), channel(), channel()});
    const float scale = std::ldexp(1.0f, static_cast<int>(random() % 40) - 24);
    const auto nearby = [&] { return static_cast<float>(random() % 4096) / 4096.0f * scale; };  // with many ties
    check({nearby(), nearby(), nearby()});
  }
  for (int exponent = 0; exponent < 32; ++exponent) {
    for (int m = 0; m < 512; ++m) {
      const vec3<float> c =
          decode_rgb9_e5<float>(static_cast<int32_t>(static_cast<uint32_t>(exponent) << 27) | m | (511 - m) << 9 | 256 << 18);
      EXPECT_EQ(c.x, std::ldexp(static_cast<float>(m), exponent - 24));
      EXPECT_EQ(c.y, std::ldexp(static_cast<float>(511 - m), exponent - 24));
      EXPECT_EQ(c.z, std::ldexp(256.0f, exponent - 24));
    }
  }
}

template <class F>
void for_each_format(const F& f) {
  for (std::size_t i = 1; i < kTexelFormats; ++i) f(static_cast<TexelFormat>(i));
}

using Bytes = std::array<std::byte, 16>;

// A texel with random bits. Every value of a channel of 8 bits occurs.
Bytes texel_of(uint32_t number, std::mt19937& random) {
  Bytes bytes;
  for (std::size_t i = 0; i < 16; ++i) bytes[i] = static_cast<std::byte>(random());
  bytes[0] = static_cast<std::byte>(number);
  bytes[1] = static_cast<std::byte>(number >> 8);
  return bytes;
}

bool is_same(float a, float b) { return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b); }
bool is_same(const glm::vec4& a, const glm::vec4& b) {
  return is_same(a.x, b.x) && is_same(a.y, b.y) && is_same(a.z, b.z) && is_same(a.w, b.w);
}

// The bytes of a texel, except for those that encode_texel() is free to change: unused bits and stencil, the bits of a NaN, the second
// code of −1 of signed normalized formats, and the common exponent.
Bytes kept_bytes(TexelFormat format, Bytes bytes, const glm::vec4& color) {
  const TexelInfo& info = texel_info(format);
  std::fill(bytes.begin() + info.bytes, bytes.end(), std::byte{0});
  if (format == TexelFormat::rgb9_e5) return Bytes{};
  if (format == TexelFormat::d24) bytes[3] = std::byte{0};
  if (format == TexelFormat::d24s8) bytes[0] = std::byte{0};
  if (format == TexelFormat::d32fs8) std::fill_n(bytes.begin() + 4, 4, std::byte{0});
  for (int k = 0; k < info.channels; ++k) {
    if (std::isnan(color[k]) && info.bits == 0) return Bytes{};
    if (!std::isnan(color[k]) && (info.kind != TexelKind::snorm || color[k] != -1.0f)) continue;
    std::fill_n(bytes.begin() + k * info.bits / 8, info.bits / 8, std::byte{0});
  }
  return bytes;
}

// For every code of 16 bits, with the others at random. A texel that was read is stored without a change.
TEST(TexelCodec, MemoryKeepsTheValuesThatItReturns) {
  std::mt19937 random(2);
  for_each_format([&](TexelFormat format) {
    const TexelInfo& info = texel_info(format);
    int different_values = 0, different_bytes = 0;
    for (uint32_t number = 0; number < 65536; ++number) {
      const Bytes bytes = texel_of(number, random);
      Bytes stored{};
      if (is_integer(format)) {
        encode_integers(format, decode_integers(format, bytes.data()), stored.data());
        different_bytes += std::memcmp(stored.data(), bytes.data(), info.bytes) != 0;
        continue;
      }
      const glm::vec4 color = decode_texel(format, bytes.data());
      if ((format == TexelFormat::d32f || format == TexelFormat::d32fs8) && !(color.x >= 0.0f && color.x <= 1.0f)) continue;
      encode_texel(format, color, stored.data());
      const glm::vec4 again = decode_texel(format, stored.data());
      for (int k = 0; k < 4; ++k) different_values += !is_same(again[k], color[k]) && !(std::isnan(again[k]) && std::isnan(color[k]));
      different_bytes += kept_bytes(format, stored, color) != kept_bytes(format, bytes, color);
    }
    EXPECT_EQ(different_values, 0) << info.name;
    EXPECT_EQ(different_bytes, 0) << info.name;
  });
}

TEST(TexelCodec, InfinitiesAreKeptInMemoryAndClampedInColors) {
  for (const TexelFormat format : {TexelFormat::r16f, TexelFormat::rgba16f, TexelFormat::r11f_g11f_b10f, TexelFormat::r32f}) {
    Bytes bytes{};
    encode_texel(format, glm::vec4(kInf), bytes.data());
    EXPECT_EQ(decode_texel(format, bytes.data()).x, kInf) << texel_info(format).name;
    encode_texel(format, glm::vec4(kMax), bytes.data());
    EXPECT_LE(decode_texel(format, bytes.data()).x, kMax);
    const vec4<float> drawn = nearest_texel(format, vec4<float>(kInf)), lowest = nearest_texel(format, vec4<float>(-kInf));
    const bool is_small = format == TexelFormat::r11f_g11f_b10f;
    EXPECT_EQ(drawn.x, format == TexelFormat::r32f ? kInf : is_small ? 65024.0f : 65504.0f);
    EXPECT_EQ(lowest.x, format == TexelFormat::r32f ? -kInf : is_small ? 0.0f : -65504.0f);
  }
}

TEST(TexelCodec, MemoryHoldsTheNearestTexel) {
  std::mt19937 random(3);
  std::normal_distribution<float> value(0.5f, 0.7f);
  for_each_format([&](TexelFormat format) {
    if (is_integer(format)) return;
    for (int i = 0; i < 20000; ++i) {
      glm::vec4 c(value(random), value(random), value(random), value(random));
      if (i % 8 == 0) c *= std::ldexp(1.0f, static_cast<int>(random() % 60) - 30);
      if (i % 50 == 0) c[i / 50 % 4] = std::array{kNan, kInf, -kInf, -0.0f, kMax}[static_cast<std::size_t>(i / 200) % 5];
      Bytes bytes{};
      const bool is_finite = std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && std::isfinite(c.w);
      const vec4<float> nearest = nearest_texel(format, vec4<float>(c.x, c.y, c.z, c.w));
      encode_texel(format, is_finite ? c : glm::vec4(nearest.x, nearest.y, nearest.z, nearest.w), bytes.data());
      ASSERT_TRUE(is_same(decode_texel(format, bytes.data()), {nearest.x, nearest.y, nearest.z, nearest.w}))
          << texel_info(format).name << ' ' << c.x << ' ' << c.y << ' ' << c.z << ' ' << c.w;
    }
  });
}

TEST(TexelCodec, LanesHaveTheBitsOfSingleTexels) {
  std::mt19937 random(4);
  for_each_format([&](TexelFormat format) {
    if (is_integer(format)) return;
    for (int i = 0; i < 2000; ++i) {
      vec4<Real> colors;
      std::array<vec4<float>, kLanes> singles;
      for (int lane = 0; lane < kLanes; ++lane) {
        const auto channel = [&] {
          return i % 2 == 0 ? std::bit_cast<float>(static_cast<uint32_t>(random())) : static_cast<float>(random() % 4096) / 2048.0f - 0.5f;
        };
        singles[static_cast<std::size_t>(lane)] = {channel(), channel(), channel(), channel()};
        set_lane(colors.x, lane, singles[static_cast<std::size_t>(lane)].x);
        set_lane(colors.y, lane, singles[static_cast<std::size_t>(lane)].y);
        set_lane(colors.z, lane, singles[static_cast<std::size_t>(lane)].z);
        set_lane(colors.w, lane, singles[static_cast<std::size_t>(lane)].w);
      }
      const vec4<Real> packet = nearest_texel(format, colors);
      for (int l = 0; l < kLanes; ++l) {
        const vec4<float> one = nearest_texel(format, singles[static_cast<std::size_t>(l)]);
        ASSERT_TRUE(is_same({lane(packet.x, l), lane(packet.y, l), lane(packet.z, l), lane(packet.w, l)}, {one.x, one.y, one.z, one.w}))
            << texel_info(format).name;
      }
    }
  });
}

TEST(TexelCodec, IntegersAreClampedToTheFormat) {
  Bytes bytes{};
  const auto stored = [&](TexelFormat format, const glm::ivec4& values) {
    encode_integers(format, values, bytes.data());
    return decode_integers(format, bytes.data());
  };
  constexpr int32_t kLow = std::numeric_limits<int32_t>::min(), kHigh = std::numeric_limits<int32_t>::max();
  EXPECT_EQ(stored(TexelFormat::rgba8i, {-129, 128, kLow, 5}), glm::ivec4(-128, 127, -128, 5));
  EXPECT_EQ(stored(TexelFormat::rgba8ui, {256, 255, -1, 0}), glm::ivec4(255, 255, 255, 0));  // −1 is 2^32 − 1
  EXPECT_EQ(stored(TexelFormat::rgba16i, {kLow, kHigh, -32768, 32767}), glm::ivec4(-32768, 32767, -32768, 32767));
  EXPECT_EQ(stored(TexelFormat::rgba16ui, {65535, 65536, -1, 1}), glm::ivec4(65535, 65535, 65535, 1));
  EXPECT_EQ(stored(TexelFormat::rgba32i, {kLow, kHigh, 0, -1}), glm::ivec4(kLow, kHigh, 0, -1));
  EXPECT_EQ(stored(TexelFormat::rgba32ui, {kLow, kHigh, 0, -1}), glm::ivec4(kLow, kHigh, 0, -1));
  EXPECT_EQ(stored(TexelFormat::rgb10_a2ui, {1023, 1024, -1, 4}), glm::ivec4(1023, 1023, 1023, 3));
  EXPECT_EQ(stored(TexelFormat::r8i, {7, 8, 9, 10}), glm::ivec4(7, 0, 0, 1));
  EXPECT_EQ(stored(TexelFormat::rg16ui, {7, 8, 9, 10}), glm::ivec4(7, 8, 0, 1));
}

TEST(TexelCodec, DepthUsesAllCodes) {
  Bytes bytes{};
  for (const uint32_t code : {0u, 1u, 8388607u, 8388608u, 16777214u, 16777215u}) {
    std::memcpy(bytes.data(), &code, 4);
    const float depth = decode_texel(TexelFormat::d24, bytes.data()).x;
    EXPECT_EQ(depth, static_cast<float>(code / 16777215.0));
    Bytes again{};
    encode_texel(TexelFormat::d24, {depth, 0, 0, 0}, again.data());
    EXPECT_EQ(std::memcmp(again.data(), bytes.data(), 4), 0) << code;
    encode_texel(TexelFormat::d24s8, {depth, 0, 0, 0}, again.data());
    const uint32_t with_stencil = code << 8;
    EXPECT_EQ(std::memcmp(again.data(), &with_stencil, 4), 0) << code;
  }
  encode_texel(TexelFormat::d32fs8, {0.25f, 0, 0, 0}, bytes.data());
  const std::array<uint32_t, 2> expected{std::bit_cast<uint32_t>(0.25f), 0};
  EXPECT_EQ(std::memcmp(bytes.data(), expected.data(), 8), 0);
}

// Words of GL_UNSIGNED_SHORT_5_6_5, 5_5_5_1 and 4_4_4_4 (OpenGL 4.6, table 8.7): the first channel is in the highest bits.
TEST(TexelFormats, SmallPackedWordsAreThoseOfOpenGl) {
  const auto color = [](TexelFormat format, uint16_t word) { return decode_texel(format, reinterpret_cast<const std::byte*>(&word)); };
  const auto word = [](TexelFormat format, const glm::vec4& c) {
    uint16_t bits = 0;
    encode_texel(format, c, reinterpret_cast<std::byte*>(&bits));
    return bits;
  };
  using enum TexelFormat;
  EXPECT_EQ(color(rgb565, 0xf800), glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(color(rgb565, 0x07e0), glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(color(rgb565, 0x001f), glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(color(rgb5_a1, 0xf800), glm::vec4(1, 0, 0, 0));
  EXPECT_EQ(color(rgb5_a1, 0x003f), glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(color(rgba4, 0xf00f), glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(color(rgba4, 0x0f30), glm::vec4(0.0f, 1.0f, 0.2f, 0.0f));
  EXPECT_EQ(word(rgb565, {1, 0, 0, 0}), 0xf800);
  EXPECT_EQ(word(rgb565, {0, 1, 0, 0}), 0x07e0);
  EXPECT_EQ(word(rgb5_a1, {0, 0, 1, 1}), 0x003f);
  EXPECT_EQ(word(rgba4, {0, 1, 0.2f, 0}), 0x0f30);
}

TEST(TexelFormats, HaveDistinctNamesAndTheSizesOfOpenGl) {
  std::set<std::string_view> names;
  for_each_format([&](TexelFormat format) {
    const TexelInfo& info = texel_info(format);
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_GT(info.bytes, 0) << info.name;
    EXPECT_LE(info.bytes, 16) << info.name;
    if (info.bits != 0) {
      EXPECT_EQ(info.bytes * 8, info.channels * info.bits) << info.name;
    }
  });
  EXPECT_EQ(names.size(), kTexelFormats - 1);
  EXPECT_EQ(texel_info(TexelFormat::rgb16f).bytes, 6);
  EXPECT_EQ(texel_info(TexelFormat::rgba32ui).bytes, 16);
  EXPECT_EQ(texel_info(TexelFormat::rgb9_e5).bytes, 4);
}

}  // namespace
}  // namespace halfspace::texel_codec
