// SPDX-License-Identifier: Apache-2.0
//
// Compares the half-precision conversions with the definition of the format (IEEE 754-2008, section 3.6), evaluated in double, and the
// bit-manipulation code with the hardware instructions.
#include "halfspace/core/half.h"

#include <gtest/gtest.h>

#include <cmath>

namespace halfspace {
namespace {

/// Value of a half, computed from the definition of the format. h must not be a NaN.
double meaning(int h) {
  const double sign = h & 0x8000 ? -1.0 : 1.0;
  const int exponent = (h >> 10) & 31, mantissa = h & 0x3ff;
  if (exponent == 31) return sign * HUGE_VAL;
  return sign * (exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25));
}

bool is_nan(int h) { return (h & 0x7fff) > 0x7c00; }

/// Returns the nearest half, ties to even. Uses a binary search, because bit patterns of the same sign are ordered by value.
int nearest_half(float x) {
  if (std::isnan(x)) return ((as_int(x) >> 16) & 0x8000) | 0x7e00 | ((as_int(x) >> 13) & 0x3ff);
  const double a = std::fabs(static_cast<double>(x));
  int low = 0, high = 0x7c00;  // meaning(low) <= a; infinity counts as 65536, the next value in the sequence
  const auto at = [](int h) { return h == 0x7c00 ? 65536.0 : meaning(h); };
  if (a >= 65536.0) low = high;
  while (high - low > 1) (at((low + high) / 2) <= a ? low : high) = (low + high) / 2;
  const double below = a - at(low), above = at(high) - a;
  const int h = low == high || above < below || (above == below && (low & 1)) ? high : low;
  return h | (std::signbit(x) ? 0x8000 : 0);
}

TEST(Half, EveryBitPatternDecodesToItsDefinedValue) {
  for (int h = 0; h < 65536; ++h) {
    const float x = half_to_float(static_cast<uint16_t>(h));
    if (is_nan(h)) {
      EXPECT_EQ(as_int(x),
                static_cast<int32_t>((static_cast<uint32_t>(h & 0x8000) << 16) | 0x7fc00000u | (static_cast<uint32_t>(h & 0x3ff) << 13)));
    } else {
      EXPECT_EQ(static_cast<double>(x), meaning(h)) << h;
      EXPECT_EQ(std::signbit(x), (h & 0x8000) != 0) << h;
    }
  }
}

TEST(Half, EveryBitPatternRoundTrips) {
  for (int h = 0; h < 65536; ++h) {
    const int quiet = is_nan(h) ? 0x200 : 0;
    EXPECT_EQ(float_to_half(half_to_float(static_cast<uint16_t>(h))), h | quiet);
  }
}

TEST(Half, RoundsToNearestEven) {
  // Test every half, every midpoint between two halves, and the floats next to the midpoint.
  for (int h = 0; h < 0x7c00; ++h) {
    const double next = h == 0x7bff ? 65536.0 : meaning(h + 1);
    const float middle = static_cast<float>((meaning(h) + next) / 2);  // exact: needs only one bit more than a half has
    for (const float x : {static_cast<float>(meaning(h)), middle, std::nextafter(middle, 0.0f), std::nextafter(middle, 1e9f)}) {
      ASSERT_EQ(float_to_half(x), nearest_half(x)) << x;
      ASSERT_EQ(float_to_half(-x), nearest_half(-x)) << -x;
    }
  }
  for (uint64_t i = 0; i < 1ull << 32; i += 4099) {  // prime stride: a million floats of all kinds, including NaN
    const float x = as_real(static_cast<int32_t>(i));
    ASSERT_EQ(float_to_half(x), nearest_half(x)) << x;
  }
}

TEST(Half, FiniteConversionNeverReturnsInfinity) {
  const float inf = std::numeric_limits<float>::infinity();
  for (const float x : {65504.0f, 65519.9f, 65520.0f, 1e9f, 3e38f, inf}) {
    EXPECT_EQ(float_to_finite_half(x), 0x7bff) << x;
    EXPECT_EQ(float_to_finite_half(-x), 0xfbff) << x;
    EXPECT_EQ(lane(float_to_finite_half(RealN<4>(x)), 2), 0x7bff) << x;
  }
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(float_to_finite_half(nan), 0x7e00);
  EXPECT_EQ(lane(float_to_finite_half(RealN<8>(nan)), 7), 0x7e00);
  EXPECT_EQ(float_to_finite_half(as_real(0x7f800001)), 0x7e00);  // signaling NaN
  for (int h = 0; h < 65536; ++h) {
    if ((h & 0x7c00) == 0x7c00) continue;
    EXPECT_EQ(float_to_finite_half(half_to_float(static_cast<uint16_t>(h))), h);
  }
}

template <int W>
void expect_conversion_of_lanes_agrees() {
  for (int h = 0; h < 65536; h += W) {
    const IntN<W> codes = iota<IntN<W>>() + h;
    const RealN<W> x = half_to_float(codes | 0x5a5a0000);  // the upper 16 bits are ignored
    const RealN<W> by_bits = detail::half_to_float_by_bits<RealN<W>>(codes);
    for (int i = 0; i < W; ++i) {
      const int32_t want = as_int(half_to_float(static_cast<uint16_t>(h + i)));
      ASSERT_EQ(as_int(lane(x, i)), want) << h + i;
      ASSERT_EQ(as_int(lane(by_bits, i)), want) << h + i;
      ASSERT_EQ(as_int(detail::half_to_float_by_bits<float>(h + i)), want) << h + i;
    }
  }
  for (uint64_t i = 0; i < 1ull << 32; i += 4093 * W) {
    RealN<W> x;
    for (int k = 0; k < W; ++k) set_lane(x, k, as_real(static_cast<int32_t>(i + static_cast<uint64_t>(k) * 4093)));
    const IntN<W> codes = float_to_half(x);
    const IntN<W> by_bits = detail::float_to_half_by_bits(x);
    for (int k = 0; k < W; ++k) {
      const int32_t want = float_to_half(lane(x, k));
      ASSERT_EQ(lane(codes, k), want) << lane(x, k);
      ASSERT_EQ(lane(by_bits, k), want) << lane(x, k);
      ASSERT_EQ(detail::float_to_half_by_bits(lane(x, k)), want) << lane(x, k);
    }
  }
}

TEST(Half, InstructionsBitOperationsAndLanesAgree) {
  expect_conversion_of_lanes_agrees<4>();
  expect_conversion_of_lanes_agrees<8>();
  expect_conversion_of_lanes_agrees<16>();
}

}  // namespace
}  // namespace halfspace
