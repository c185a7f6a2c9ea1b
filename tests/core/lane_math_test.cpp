// SPDX-License-Identifier: Apache-2.0
//
// Tests the accuracy of the math functions against the double functions of std (their error of about 1e-16 is negligible here), exact
// special values, monotonicity, and that all lane widths return the same bits.
//
// For functions of one argument, each bound is the largest error over every float of the domain (measured once over 3e9 values), rounded
// up. The sweeps here visit about 2^22 floats each; they cannot exceed the bound because results are bit-identical on every machine. pow
// and atan2 can only be sampled, so their bounds leave 0.1 ulp above the largest error found. A correctly rounded function would have a
// bound of 0.5.
#include "halfspace/core/lane_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <vector>

#include "support/constants.h"
#include "support/expected_hash.h"
#include "support/hash.h"

namespace halfspace {
namespace {

/// Absolute error of got in float ulps of want.
double ulps(float got, double want) {
  if (std::isnan(want)) return std::isnan(got) ? 0.0 : 1e30;
  if (std::fabs(want) >= 0x1.ffffffp127) return std::fabs(got) == kInf && (got > 0) == (want > 0) ? 0.0 : 1e30;
  if (!std::isfinite(got)) return 1e30;
  const int exponent = want == 0 ? -200 : std::ilogb(want);
  return std::fabs(static_cast<double>(got) - want) / std::ldexp(1.0, std::max(exponent, -126) - 23);
}

struct Worst {
  double ulp = 0.0;
  float x = 0.0f, y = 0.0f;
  void add(double error, float at_x, float at_y = 0.0f) {
    if (error > ulp) *this = {error, at_x, at_y};
  }
};
std::ostream& operator<<(std::ostream& out, const Worst& w) { return out << w.ulp << " ulp at " << w.x << ", " << w.y; }

/// Returns the largest error over about 2^22 floats that cover every exponent in [lo, hi]. Both bounds must have the same sign.
template <class F, class G>
Worst sweep(F f, G reference, float lo, float hi) {
  Worst worst;
  const int64_t a = std::min(as_int(abs(lo)), as_int(abs(hi))), b = std::max(as_int(abs(lo)), as_int(abs(hi)));
  const int64_t stride = std::max<int64_t>(1, (b - a) >> 22) | 1;
  for (int64_t i = a; i <= b; i += stride) {
    const float x = std::copysign(as_real(static_cast<int32_t>(i)), std::signbit(lo) ? -1.0f : 1.0f);
    worst.add(ulps(f(x), reference(static_cast<double>(x))), x);
  }
  return worst;
}

/// Returns the largest error over 2^22 floats evenly spaced in [lo, hi].
template <class F, class G>
Worst sweep_evenly(F f, G reference, float lo, float hi) {
  Worst worst;
  const double step = (static_cast<double>(hi) - static_cast<double>(lo)) / (1 << 22);
  for (int i = 0; i <= (1 << 22); ++i) {
    const float x = static_cast<float>(static_cast<double>(lo) + i * step);
    worst.add(ulps(f(x), reference(static_cast<double>(x))), x);
  }
  return worst;
}

void expect_at_most(double bound, const char* what, const Worst& worst) {
  if (std::getenv("HALFSPACE_PRINT_ULPS") != nullptr) std::cout << what << ": " << worst << '\n';
  EXPECT_LE(worst.ulp, bound) << what << ": " << worst;
}

TEST(LaneMath, InverseSqrtIsWithinErrorBound) {
  const auto f = [](float x) { return inverse_sqrt(x); };
  const auto g = [](double x) { return 1.0 / std::sqrt(x); };
  // Test every float of two binades, which covers every mantissa with an even and an odd exponent, and then sample all exponents.
  Worst worst;
  for (int32_t i = as_int(1.0f); i < as_int(4.0f); ++i) worst.add(ulps(f(as_real(i)), g(static_cast<double>(as_real(i)))), as_real(i));
  expect_at_most(1.32, "inverse_sqrt 1 to 4", worst);
  expect_at_most(1.32, "inverse_sqrt", sweep(f, g, 0x1p-126f, 0x1.fffffep127f));
  for (float x = 0x1p-127f; x > 0.0f; x *= 0.5f) EXPECT_TRUE(f(x) > 0.0f && f(x) <= g(static_cast<double>(x))) << x;
}

TEST(LaneMath, UnitPowIsWithinErrorBound) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f), exponent(-7.0f, 17.0f);
  double worst = 0.0;
  for (int i = 0; i < 1 << 20; ++i) {
    const float y = std::exp2(exponent(random));
    // Half of the bases are so close to 1 that large exponents do not make the result underflow to 0.
    const float x = (i & 1) != 0 ? unit(random) : 1.0f - unit(random) * std::min(1.0f, 8.0f / y);
    worst = std::max(worst, std::fabs(static_cast<double>(unit_pow(x, y)) - std::pow(static_cast<double>(x), static_cast<double>(y))));
  }
  if (std::getenv("HALFSPACE_PRINT_ULPS") != nullptr) std::cout << "unit_pow: " << worst << '\n';
  EXPECT_LE(worst, 6e-7);  // bound documented at unit_pow; the largest error found with random pairs is 5.1e-7
  EXPECT_GT(worst, 1e-8);  // ensures that not all pairs have trivial results
  EXPECT_EQ(unit_pow(0.0f, 0.0f), 1.0f);
  EXPECT_EQ(unit_pow(0.5f, 0.0f), 1.0f);
  EXPECT_EQ(unit_pow(0.0f, 3.0f), 0.0f);
  EXPECT_EQ(unit_pow(1.0f, 1e5f), 1.0f);
  EXPECT_EQ(unit_pow(kNaN, 0.0f), 1.0f);
  EXPECT_TRUE(std::isnan(unit_pow(kNaN, 2.0f)));
}

TEST(LaneMath, Exp2IsWithinErrorBound) {
  const auto f = [](float x) { return exp2(x); };
  const auto g = [](double x) { return std::exp2(x); };
  expect_at_most(0.96, "exp2 positive", sweep(f, g, 0.0f, 200.0f));
  expect_at_most(0.96, "exp2 negative", sweep(f, g, -0.0f, -200.0f));
  expect_at_most(0.96, "exp2 even", sweep_evenly(f, g, -151.0f, 128.5f));
  for (int n = -149; n < 128; ++n) EXPECT_EQ(exp2(static_cast<float>(n)), std::ldexp(1.0f, n));
}

TEST(LaneMath, ExpIsWithinErrorBound) {
  const auto f = [](float x) { return exp(x); };
  const auto g = [](double x) { return std::exp(x); };
  expect_at_most(1.02, "exp positive", sweep(f, g, 0.0f, 100.0f));
  expect_at_most(1.02, "exp negative", sweep(f, g, -0.0f, -120.0f));
  expect_at_most(1.02, "exp even", sweep_evenly(f, g, -105.0f, 89.5f));
}

TEST(LaneMath, LogarithmsAreWithinErrorBound) {
  const auto f2 = [](float x) { return log2(x); };
  const auto g2 = [](double x) { return std::log2(x); };
  const auto fe = [](float x) { return log(x); };
  const auto ge = [](double x) { return std::log(x); };
  expect_at_most(1.04, "log2 all", sweep(f2, g2, 0x1p-149f, 0x1.fffffep127f));
  expect_at_most(1.04, "log2 near 1", sweep(f2, g2, 0.5f, 2.0f));
  expect_at_most(0.9, "log all", sweep(fe, ge, 0x1p-149f, 0x1.fffffep127f));
  expect_at_most(0.9, "log near 1", sweep(fe, ge, 0.5f, 2.0f));
  for (int n = -149; n < 128; ++n) EXPECT_EQ(log2(std::ldexp(1.0f, n)), static_cast<float>(n));
}

/// Samples bases of every exponent and bases near 1, with exponents that spread the result over the whole float range.
Worst sweep_pow(float y_limit, int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Worst worst;
  for (int i = 0; i < count; ++i) {
    const double spread = i % 2 == 0 ? 127.0 : std::exp2(unit(random) * 12.0 - 12.0);
    const float x = static_cast<float>(std::exp2(spread * unit(random)));
    if (x == 1.0f || x == 0.0f || x == kInf) continue;
    const double log_x = std::log2(static_cast<double>(x));
    const float y =
        static_cast<float>(std::clamp(150.0 * unit(random) / log_x, -static_cast<double>(y_limit), static_cast<double>(y_limit)));
    worst.add(ulps(pow(x, y), std::pow(static_cast<double>(x), static_cast<double>(y))), x, y);
  }
  return worst;
}

TEST(LaneMath, PowIsWithinErrorBound) {
  expect_at_most(1.2, "pow |y| <= 8", sweep_pow(8.0f, 1 << 21));
  expect_at_most(1.2, "pow |y| <= 1e5", sweep_pow(1e5f, 1 << 21));
  expect_at_most(1.2, "pow any y", sweep_pow(1e9f, 1 << 21));
  // Exponents that are common in shading: gamma and specular.
  for (const float y : {2.4f, 1.0f / 2.4f, 2.2f, 5.0f, 32.0f, 1000.0f}) {
    const auto g = [y](double x) { return std::pow(x, static_cast<double>(y)); };
    expect_at_most(1.2, "pow of cosines", sweep([y](float x) { return pow(x, y); }, g, 0x1p-20f, 1.0f));
  }
}

TEST(LaneMath, SinAndCosAreWithinErrorBound) {
  const auto f = [](float x) { return sin(x); };
  const auto g = [](double x) { return std::sin(x); };
  const auto fc = [](float x) { return cos(x); };
  const auto gc = [](double x) { return std::cos(x); };
  expect_at_most(1.54, "sin all exponents", sweep(f, g, 0.0f, 1e4f));
  expect_at_most(1.54, "sin even", sweep_evenly(f, g, -1e4f, 1e4f));
  expect_at_most(1.54, "sin near 0", sweep_evenly(f, g, -7.0f, 7.0f));
  expect_at_most(1.54, "cos all exponents", sweep(fc, gc, 0.0f, 1e4f));
  expect_at_most(1.54, "cos even", sweep_evenly(fc, gc, -1e4f, 1e4f));
  expect_at_most(1.54, "cos near 0", sweep_evenly(fc, gc, -7.0f, 7.0f));
}

TEST(LaneMath, SinAndCosKeepRelativeAccuracyNearTheirZeros) {
  Worst worst;
  for (int n = 1; n <= 6366; ++n) {  // multiples of π/2 up to 1e4, and the floats next to each
    float x = static_cast<float>(n * 1.57079632679489661923);
    for (int k = 0; k < 8; ++k) x = std::nextafter(x, 0.0f);
    for (int k = 0; k < 16; ++k, x = std::nextafter(x, 1e9f)) {
      const double want_sin = std::sin(static_cast<double>(x)), want_cos = std::cos(static_cast<double>(x));
      worst.add(std::max(ulps(sin(x), want_sin), ulps(cos(x), want_cos)), x);
    }
  }
  expect_at_most(1.54, "sin, cos at their zeros", worst);
}

TEST(LaneMath, SinAndCosOfLargeArgumentsStayBoundedAndLoseAccuracyGradually) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> large(1e4f, 1e6f);
  for (int i = 0; i < 1 << 18; ++i) {
    const float x = large(random);
    // The quadrant n is computed with an error of up to 636620·2^-23 = 0.08, so the polynomials are evaluated up to 0.12 outside their
    // interval of ±0.785, where their error grows to 3e-7. The reduced angle itself stays accurate to a few ulp.
    EXPECT_NEAR(static_cast<double>(sin(x)), std::sin(static_cast<double>(x)), 1e-6) << x;
    EXPECT_NEAR(static_cast<double>(cos(x)), std::cos(static_cast<double>(x)), 1e-6) << x;
  }
  for (float x = 1e6f; x < kInf; x *= 1.7f) {
    EXPECT_LE(std::fabs(sin(x)), 1.0f);
    EXPECT_LE(std::fabs(cos(x)), 1.0f);
  }
}

TEST(LaneMath, AtanAndAtan2AreWithinErrorBound) {
  const auto g = [](double x) { return std::atan(x); };
  expect_at_most(1.4, "atan", sweep([](float x) { return atan(x); }, g, 0x1p-149f, 0x1.fffffep127f));
  expect_at_most(1.4, "atan of -1 ... 1", sweep_evenly([](float x) { return atan(x); }, g, -1.0f, 1.0f));
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  Worst worst;
  for (int i = 0; i < 1 << 21; ++i) {
    const float x = unit(random) * std::exp2(20.0f * unit(random)), y = unit(random);
    worst.add(ulps(atan2(y, x), std::atan2(static_cast<double>(y), static_cast<double>(x))), x, y);
  }
  expect_at_most(1.5, "atan2", worst);
}

TEST(LaneMath, AsinAndAcosAreWithinErrorBound) {
  const auto s = [](float x) { return asin(x); };
  const auto c = [](float x) { return acos(x); };
  const auto gs = [](double x) { return std::asin(x); };
  const auto gc = [](double x) { return std::acos(x); };
  expect_at_most(2.37, "asin", sweep(s, gs, 0.0f, 1.0f));
  expect_at_most(2.37, "asin even", sweep_evenly(s, gs, -1.0f, 1.0f));
  expect_at_most(1.13, "acos", sweep(c, gc, 0.0f, 1.0f));
  expect_at_most(1.13, "acos even", sweep_evenly(c, gc, -1.0f, 1.0f));
}

void expect_value(const char* what, float got, float want) {
  if (std::isnan(want))
    EXPECT_TRUE(std::isnan(got)) << what << " is " << got;
  else
    EXPECT_EQ(as_int(got), as_int(want)) << what << " is " << got;
}
#define EXPECT_VALUE(expression, want) expect_value(#expression, expression, want)

TEST(LaneMath, ExpAndLogHandleSpecialValues) {
  for (const float x : {0.0f, -0.0f}) {
    EXPECT_VALUE(exp2(x), 1.0f);
    EXPECT_VALUE(exp(x), 1.0f);
    EXPECT_VALUE(log2(x), -kInf);
    EXPECT_VALUE(log(x), -kInf);
  }
  EXPECT_VALUE(exp2(-kInf), 0.0f);
  EXPECT_VALUE(exp2(kInf), kInf);
  EXPECT_VALUE(exp2(128.0f), kInf);
  EXPECT_VALUE(exp2(-1e30f), 0.0f);
  EXPECT_VALUE(exp2(kNaN), kNaN);
  EXPECT_VALUE(exp(-kInf), 0.0f);
  EXPECT_VALUE(exp(1e30f), kInf);
  EXPECT_VALUE(exp(kNaN), kNaN);
  for (const float x : {-1.0f, -0x1p-149f, -kInf, kNaN}) {
    EXPECT_VALUE(log2(x), kNaN);
    EXPECT_VALUE(log(x), kNaN);
  }
  EXPECT_VALUE(log2(kInf), kInf);
  EXPECT_VALUE(log(kInf), kInf);
  EXPECT_VALUE(log2(1.0f), 0.0f);
  EXPECT_VALUE(log(1.0f), 0.0f);
}

TEST(LaneMath, PowFollowsIeeeForSpecialValuesOfNonNegativeBases) {
  const float values[] = {0.0f, -0.0f, 0x1p-149f, 0.5f, 1.0f, 2.0f, 3.0f, 0x1.fffffep127f, kInf, kNaN, -1.0f, -0.5f, -kInf};
  for (const float x : values) {
    for (const float y : values) {
      const bool negative = x < 0.0f && y != 0.0f;
      const double want = negative ? static_cast<double>(kNaN) : std::pow(x == 0.0f ? 0.0 : static_cast<double>(x), static_cast<double>(y));
      // 0, 1, infinity and NaN must be exact; other values have the error bound of pow.
      const bool exact = !std::isfinite(want) || want == 0.0 || want == 1.0;
      EXPECT_LE(ulps(pow(x, y), want), exact ? 0.0 : 1.2) << x << " to the " << y;
      const float from_double = static_cast<float>(pow(static_cast<double>(x), static_cast<double>(y)));
      EXPECT_EQ(std::isnan(from_double), std::isnan(pow(x, y))) << x << ' ' << y;
    }
  }
}

TEST(LaneMath, TrigonometricFunctionsFollowIeeeForSpecialValues) {
  const float values[] = {0.0f, -0.0f, 1.0f, -1.0f, kInf, -kInf, kNaN, 0x1p-149f, -0x1p-149f, 0x1.fffffep127f};
  for (const float y : values) {
    for (const float x : values) {
      const double want = std::atan2(static_cast<double>(y), static_cast<double>(x));
      expect_value("atan2", atan2(y, x), static_cast<float>(want));
    }
  }
  for (const float x : {kInf, -kInf, kNaN}) {
    EXPECT_VALUE(sin(x), kNaN);
    EXPECT_VALUE(cos(x), kNaN);
    EXPECT_VALUE(asin(x), kNaN);
    EXPECT_VALUE(acos(x), kNaN);
  }
  EXPECT_VALUE(sin(0.0f), 0.0f);
  EXPECT_VALUE(sin(-0.0f), -0.0f);
  EXPECT_VALUE(cos(-0.0f), 1.0f);
  EXPECT_VALUE(asin(-0.0f), -0.0f);
  EXPECT_VALUE(asin(1.0f), 1.57079637f);
  EXPECT_VALUE(acos(1.0f), 0.0f);
  EXPECT_VALUE(acos(-1.0f), 3.14159274f);
  EXPECT_VALUE(acos(1.0000001f), kNaN);
}

/// Checks that f never decreases from one float to the next in [lo, hi].
template <class F>
void expect_monotone(const char* what, F f, float lo, float hi) {
  float last = f(lo);
  for (float x = lo; x <= hi; x = std::nextafter(x, kInf)) {
    const float value = f(x);
    ASSERT_GE(value, last) << what << " decreases at " << x;
    last = value;
  }
}

TEST(LaneMath, ExponentialsAndLogarithmsAreMonotonic) {
  // Tests every float of at least one octave. Argument reduction maps all other octaves to the same computation.
  expect_monotone(
      "exp2", [](float x) { return exp2(x); }, 1.0f, 2.0f);
  expect_monotone(
      "exp", [](float x) { return exp(x); }, 1.0f, 2.0f);
  expect_monotone(
      "log2", [](float x) { return log2(x); }, 0.7f, 3.0f);
  expect_monotone(
      "log", [](float x) { return log(x); }, 0.7f, 3.0f);
  expect_monotone(
      "square root by pow", [](float x) { return pow(x, 0.5f); }, 1.0f, 4.0f);
  expect_monotone(
      "gamma by pow", [](float x) { return pow(x, 2.4f); }, 0.25f, 1.0f);
}

/// Compares f at width W with scalar f over floats of all bit patterns. NaNs may differ in their bits.
template <int W, class F>
void expect_width_agrees(const char* what, F f) {
  constexpr uint32_t kStride = 9973;  // prime: covers all low bits, signs and exponents in 430,000 inputs
  uint32_t pattern = 0;
  for (int packet = 0; packet < (1 << 22) / (W * 10); ++packet) {
    RealN<W> x, y;
    for (int i = 0; i < W; ++i, pattern += kStride) {
      set_lane(x, i, as_real(static_cast<int32_t>(pattern)));
      // y is the exponent of pow and the second argument of atan2: half of the values are ordinary, half are arbitrary bit patterns.
      const uint32_t other = pattern * 2654435761u;
      set_lane(y, i, other & 1 ? as_real(static_cast<int32_t>(other)) : static_cast<float>(static_cast<int32_t>(other)) * 0x1p-24f);
    }
    const RealN<W> got = f(x, y);
    for (int i = 0; i < W; ++i) {
      const float want = f(lane(x, i), lane(y, i));
      if (std::isnan(want) && std::isnan(lane(got, i))) continue;
      ASSERT_EQ(as_int(lane(got, i)), as_int(want)) << what << " at width " << W << " of " << lane(x, i) << ", " << lane(y, i);
    }
  }
}
template <class F>
void expect_all_widths_agree(const char* what, F f) {
  expect_width_agrees<4>(what, f);
  expect_width_agrees<8>(what, f);
  expect_width_agrees<16>(what, f);
}

TEST(LaneMath, LanesMatchScalarBits) {
  expect_all_widths_agree("exp2", [](auto x, auto) { return exp2(x); });
  expect_all_widths_agree("exp", [](auto x, auto) { return exp(x); });
  expect_all_widths_agree("log2", [](auto x, auto) { return log2(x); });
  expect_all_widths_agree("log", [](auto x, auto) { return log(x); });
  expect_all_widths_agree("pow", [](auto x, auto y) { return pow(x, y); });
  expect_all_widths_agree("pow of |x|", [](auto x, auto y) { return pow(abs(x), y); });
  expect_all_widths_agree("sin", [](auto x, auto) { return sin(x); });
  expect_all_widths_agree("cos", [](auto x, auto) { return cos(x); });
  expect_all_widths_agree("sin of y", [](auto, auto y) { return sin(y); });
  expect_all_widths_agree("cos of y", [](auto, auto y) { return cos(y); });
  expect_all_widths_agree("atan2", [](auto x, auto y) { return atan2(x, y); });
  expect_all_widths_agree("atan", [](auto x, auto) { return atan(x); });
  expect_all_widths_agree("inverse_sqrt", [](auto x, auto) { return inverse_sqrt(abs(x)); });
  expect_all_widths_agree("unit_pow", [](auto x, auto y) { return unit_pow(abs(x), abs(y)); });
  expect_all_widths_agree("asin", [](auto x, auto) { return asin(x); });
  expect_all_widths_agree("acos", [](auto x, auto) { return acos(x); });
}

/// Detects differences between compilers, optimization levels and CPUs. The hash changes only when the arithmetic of a function is changed
/// on purpose.
TEST(LaneMath, MatchesTheCommittedHash) {
  Hash hash;
  const auto add = [&hash](float value) { hash.add(std::isnan(value) ? 0x7fc00000u : static_cast<uint32_t>(as_int(value))); };
  for (uint32_t pattern = 0, n = 0; n < 1u << 17; ++n, pattern += 32749) {
    const float x = as_real(static_cast<int32_t>(pattern));
    const float y = static_cast<float>(static_cast<int32_t>(n) - (1 << 16)) * 0x1p-9f;
    for (const float v : {exp2(y), exp(y), log2(x), log(x), pow(abs(x), y), sin(x), cos(x), sin(y), cos(y), atan2(x, y), asin(x), acos(x)})
      add(v);
  }
  expect_hash("lane-math", hash.value());
}

}  // namespace
}  // namespace halfspace
