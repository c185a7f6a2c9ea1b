// SPDX-License-Identifier: Apache-2.0
//
// Compares the sRGB tables with the transfer function in long double (64-bit mantissa; the error of powl is below 2^-62). The tests also
// check that every value is much farther than this error from the nearest rounding boundary, which proves that the tables are correctly
// rounded. Encoding is tested with every float that encodes to a value above 0.
#include "halfspace/core/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

#include "halfspace/core/half.h"

namespace halfspace {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64);

long double decode(long double v) { return v <= 0.04045L ? v / 12.92L : std::pow((v + 0.055L) / 1.055L, 2.4L); }
long double encode(long double x) { return x <= 0.0031308L ? 12.92L * x : 1.055L * std::pow(x, 1.0L / 2.4L) - 0.055L; }

/// Lower bound of the interval that encodes to c: the linear value at which the encoded value is c − 1/2.
long double threshold(int c) { return decode((2 * c - 1) / 510.0L); }

constexpr int32_t kOne = 0x3f800000;

TEST(Srgb, DecodesToTheNearestFloat) {
  for (int c = 1; c < 256; ++c) {
    const float got = srgb_to_linear<float>(c);
    const long double want = decode(c / 255.0L);
    const long double below = (static_cast<long double>(got) + std::nextafter(got, 0.0f)) / 2;
    const long double above = (static_cast<long double>(got) + std::nextafter(got, 2.0f)) / 2;
    // The exact value is between the two rounding boundaries with a margin that is larger than the error of both long double here (2^-62)
    // and the compiler's double in srgb.cpp (2^-50).
    EXPECT_GT(want, below + want * 0x1p-40L) << c;
    EXPECT_LT(want, above - want * 0x1p-40L) << c;
  }
  EXPECT_EQ(srgb_to_linear<float>(0), 0.0f);
  EXPECT_EQ(srgb_to_linear<float>(255), 1.0f);
}

TEST(Srgb, EveryValueRoundTrips) {
  for (int c = 0; c < 256; ++c) {
    EXPECT_EQ(linear_to_srgb(srgb_to_linear<float>(c)), c);
    EXPECT_EQ(linear_to_srgb(srgb_to_linear<double>(c)), c);
    EXPECT_EQ(linear_to_unorm8(unorm8_to_linear(static_cast<float>(c))), c);
    EXPECT_EQ(linear_to_unorm8(unorm8_to_linear(static_cast<double>(c))), c);
  }
}

TEST(Srgb, NoThresholdIsNearAFloat) {
  for (int c = 1; c < 256; ++c) {
    const long double t = threshold(c);
    const float nearest = static_cast<float>(t);
    EXPECT_GT(std::fabs(static_cast<long double>(nearest) - t), t * 0x1p-40L) << c;
  }
}

TEST(Srgb, EveryFloatEncodesToTheNearestValue) {
  int code = 0;
  float next = static_cast<float>(threshold(1));
  const auto first_at_or_above = [](int c) {
    const float f = static_cast<float>(threshold(c));
    return static_cast<long double>(f) < threshold(c) ? std::nextafter(f, 2.0f) : f;
  };
  next = first_at_or_above(1);
  int64_t wrong = 0;
  for (int32_t i = 0x38000000; i <= kOne; i += 16) {  // every float from 2^-15 to 1
    const RealN<16> x = as_real(iota<IntN<16>>() + i);
    const IntN<16> got = linear_to_srgb(x);
    for (int k = 0; k < 16 && i + k <= kOne; ++k) {
      while (code < 255 && lane(x, k) >= next) next = ++code < 255 ? first_at_or_above(code + 1) : 2.0f;
      wrong += lane(got, k) != code;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(code, 255);
  for (int32_t i = 0; i < 0x38000000; i += 1009) ASSERT_EQ(linear_to_srgb(as_real(i)), 0);  // a sample of the floats below
}

TEST(Srgb, EveryHalfEncodesToTheRoundedCurve) {
  for (int h = 0; h < 65536; ++h) {
    const float x = half_to_float(static_cast<uint16_t>(h));
    const long double clamped = x > 0 ? std::min(static_cast<long double>(x), 1.0L) : 0.0L;  // NaN encodes to 0
    EXPECT_EQ(linear_to_srgb(x), static_cast<int>(std::floor(encode(clamped) * 255 + 0.5L))) << x;
  }
}

TEST(Srgb, EveryFloatConvertsToTheNearestUnorm8) {
  int64_t wrong = 0;
  for (int32_t i = 0x3a000000; i <= kOne; i += 16) {  // every float from 2^-11 to 1; 0.5/255 is about 2^-9
    const RealN<16> x = as_real(iota<IntN<16>>() + i);
    const IntN<16> got = linear_to_unorm8(x);
    for (int k = 0; k < 16 && i + k <= kOne; ++k) {
      const double exact = static_cast<double>(lane(x, k)) * 255.0;  // exact: needs 24 + 8 bits
      wrong += lane(got, k) != static_cast<int>(exact + 0.5);        // also exact, and never a tie
    }
  }
  EXPECT_EQ(wrong, 0);
  for (int c = 0; c < 256; ++c) EXPECT_EQ(unorm8_to_linear(static_cast<float>(c)), static_cast<float>(c) / 255.0f);
}

TEST(Srgb, Unorm16DecodesToTheNearestFloat) {
  for (int c = 0; c < 65536; ++c) ASSERT_EQ(unorm16_to_linear(static_cast<float>(c)), static_cast<float>(c) / 65535.0f);
  float last = 0.0f;
  for (float x = 0.0f; x <= 65535.0f; x += 0x1p-5f) {  // includes values between integers
    ASSERT_GE(unorm16_to_linear(x), last);
    last = unorm16_to_linear(x);
  }
  EXPECT_EQ(last, 1.0f);
}

TEST(Srgb, ClampsOutOfRangeValues) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {-1.0f, -inf, nan, -nan, 0.0f, -0.0f, 0x1p-149f}) {
    EXPECT_EQ(linear_to_srgb(x), 0) << x;
    EXPECT_EQ(linear_to_unorm8(x), 0) << x;
    EXPECT_EQ(linear_to_srgb(static_cast<double>(x)), 0) << x;
    EXPECT_EQ(linear_to_unorm8(static_cast<double>(x)), 0) << x;
  }
  for (const float x : {1.0f, 1.5f, 1e30f, inf}) {
    EXPECT_EQ(linear_to_srgb(x), 255) << x;
    EXPECT_EQ(linear_to_unorm8(x), 255) << x;
    EXPECT_EQ(linear_to_unorm8(static_cast<double>(x)), 255) << x;
  }
}

template <int W>
void expect_encoding_of_lanes_agrees() {
  for (uint64_t i = 0; i < 1ull << 32; i += 4093 * W) {
    RealN<W> x;
    for (int k = 0; k < W; ++k) set_lane(x, k, as_real(static_cast<int32_t>(i + static_cast<uint64_t>(k) * 4093)));
    const IntN<W> srgb = linear_to_srgb(x), unorm = linear_to_unorm8(x);
    const RealN<W> linear = srgb_to_linear<RealN<W>>(srgb), plain = unorm8_to_linear(clamp(x, 0.0f, 255.0f));
    for (int k = 0; k < W; ++k) {
      ASSERT_EQ(lane(srgb, k), linear_to_srgb(lane(x, k))) << lane(x, k);
      ASSERT_EQ(lane(unorm, k), linear_to_unorm8(lane(x, k))) << lane(x, k);
      ASSERT_EQ(as_int(lane(linear, k)), as_int(srgb_to_linear<float>(lane(srgb, k)))) << lane(x, k);
      ASSERT_EQ(as_int(lane(plain, k)), as_int(unorm8_to_linear(clamp(lane(x, k), 0.0f, 255.0f)))) << lane(x, k);
    }
  }
}

TEST(Srgb, LanesMatchScalarBits) {
  expect_encoding_of_lanes_agrees<4>();
  expect_encoding_of_lanes_agrees<8>();
  expect_encoding_of_lanes_agrees<16>();
}

}  // namespace
}  // namespace halfspace
