// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/trig_double.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "support/expected_hash.h"
#include "support/hash.h"

namespace halfspace {
namespace {

// Absolute error of got in double ulps of want. Near zero, the ulp of the smallest normal number is used.
double ulps(double got, long double want) {
  const double size = std::max(std::fabs(static_cast<double>(want)), std::numeric_limits<double>::min());
  const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return std::fabs(static_cast<double>((static_cast<long double>(got) - want) / ulp));
}

// The references are computed in long double, which has a 64-bit mantissa here.
constexpr long double kTwoPi = 2.0L * std::numbers::pi_v<long double>;

TEST(TrigDouble, QuarterTurnsAreExact) {
  const double sines[] = {0, 1, 0, -1};
  for (int q = -9; q <= 9; ++q) {
    const SinCosDouble a = sincos_turns(0.25 * q);
    EXPECT_EQ(a.sin, sines[(q + 12) % 4]) << q;
    EXPECT_EQ(a.cos, sines[(q + 13) % 4]) << q;
    EXPECT_FALSE(std::signbit(a.sin) && a.sin == 0.0) << "negative zero at quarter turn " << q;
    EXPECT_FALSE(std::signbit(a.cos) && a.cos == 0.0) << q;
  }
}

TEST(TrigDouble, IsWithinOneUlpOfLongDouble) {
  double worst = 0;
  for (int i = 0; i <= 200000; ++i) {
    const double t = i / 800000.0;  // at most a quarter turn
    const SinCosDouble a = sincos_turns(t);
    // Near a quarter turn, rounding of its argument would make the long double cosine inaccurate. The sine of the remaining angle, which is
    // exact, gives the same value.
    const long double rest = 0.25L - static_cast<long double>(t);
    worst = std::max({worst, ulps(a.sin, std::sin(kTwoPi * static_cast<long double>(t))), ulps(a.cos, std::sin(kTwoPi * rest))});
  }
  EXPECT_LE(worst, 1.0);
  std::printf("largest error %.3f ulp\n", worst);
}

TEST(TrigDouble, TinyAnglesKeepRelativeAccuracy) {
  for (double t = 1e-3; t > 1e-300; t *= 1e-3)
    EXPECT_LE(ulps(sincos_turns(t).sin,
                   kTwoPi * static_cast<long double>(t) *
                       (t < 1e-8 ? 1 : std::sin(kTwoPi * static_cast<long double>(t)) / (kTwoPi * static_cast<long double>(t)))),
              1.0)
        << t;
}

TEST(TrigDouble, IsPeriodicInWholeTurns) {
  for (int i = -64; i <= 64; ++i) {
    const double t = i / 128.0;
    for (const double turns : {1.0, -3.0, 1048576.0}) {
      EXPECT_EQ(sincos_turns(t + turns).sin, sincos_turns(t).sin);
      EXPECT_EQ(sincos_turns(t + turns).cos, sincos_turns(t).cos);
    }
  }
}

TEST(TrigDouble, SineIsOddAndCosineIsEven) {
  for (int i = 1; i < 1000; ++i) {
    const double t = i * 0.001234567;
    EXPECT_EQ(sincos_turns(-t).sin, -sincos_turns(t).sin);
    EXPECT_EQ(sincos_turns(-t).cos, sincos_turns(t).cos);
  }
}

// Every compiler and processor must compute the same bits.
TEST(TrigDouble, MatchesTheCommittedHash) {
  Hash hash;
  for (int i = 0; i < 10000; ++i) {
    const SinCosDouble a = sincos_turns(i * 0.000123456789);
    for (const double d : {a.sin, a.cos}) hash.add(std::bit_cast<uint64_t>(d));
  }
  expect_hash("sincos-turns", hash.value());
}

}  // namespace
}  // namespace halfspace
