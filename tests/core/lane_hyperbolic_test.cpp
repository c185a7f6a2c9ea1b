// SPDX-License-Identifier: Apache-2.0
//
// Tests the accuracy of tan and of the hyperbolic functions against the long double functions of std, special values, and that lanes
// return the bits of scalars. Each bound is the largest error that was found, rounded up, when every float of the main range and every 23rd
// or 101st of the rest were measured once. The sweeps here visit a part of them.
#include "halfspace/core/lane_hyperbolic.h"

#include "core/glsl_lanes.h"
#include "support/expected_hash.h"
#include "support/hash.h"

namespace halfspace {
namespace {

TEST(LaneHyperbolic, FunctionsAreWithinTheirErrorBounds) {
  EXPECT_LE(largest_glsl_error([](float x) { return tan(x); }, [](long double x) { return std::tan(x); }, 0.0f, 1e4f), 3.33);
  EXPECT_LE(largest_glsl_error([](float x) { return sinh(x); }, [](long double x) { return std::sinh(x); }, 0.0f, 100.0f), 1.62);
  EXPECT_LE(largest_glsl_error([](float x) { return sinh(x); }, [](long double x) { return std::sinh(x); }, 0.5f, 90.0f), 1.62);
  EXPECT_LE(largest_glsl_error([](float x) { return cosh(x); }, [](long double x) { return std::cosh(x); }, 0.0f, 100.0f), 1.46);
  EXPECT_LE(largest_glsl_error([](float x) { return cosh(x); }, [](long double x) { return std::cosh(x); }, 0.1f, 90.0f), 1.46);
  EXPECT_LE(largest_glsl_error([](float x) { return tanh(x); }, [](long double x) { return std::tanh(x); }, 0.0f, 100.0f), 1.34);
  EXPECT_LE(largest_glsl_error([](float x) { return tanh(x); }, [](long double x) { return std::tanh(x); }, 0.3f, 10.0f), 1.34);
  EXPECT_LE(largest_glsl_error([](float x) { return asinh(x); }, [](long double x) { return std::asinh(x); }, 0.0f, 0x1.fffffep127f), 2.07);
  EXPECT_LE(largest_glsl_error([](float x) { return asinh(x); }, [](long double x) { return std::asinh(x); }, 0.01f, 10.0f), 2.07);
  EXPECT_LE(largest_glsl_error([](float x) { return acosh(x); }, [](long double x) { return std::acosh(x); }, 0.9f, 0x1.fffffep127f), 2.89);
  EXPECT_LE(largest_glsl_error([](float x) { return acosh(x); }, [](long double x) { return std::acosh(x); }, 1.0f, 1.1f), 2.89);
  EXPECT_LE(largest_glsl_error([](float x) { return atanh(x); }, [](long double x) { return std::atanh(x); }, 0.0f, 1.1f), 2.52);
  EXPECT_LE(largest_glsl_error([](float x) { return atanh(x); }, [](long double x) { return std::atanh(x); }, 0.01f, 1.0f), 2.52);
}

TEST(LaneHyperbolic, SpecialValuesFollowTheCLibrary) {
  for (const float x : {0.0f, -0.0f, kInf, -kInf, kNaN, 1.0f, -1.0f, 0x1p-149f, -0x1p-149f}) {
    const double d = static_cast<double>(x);
    EXPECT_TRUE(std::isfinite(std::sinh(d)) || same_bits(sinh(x), static_cast<float>(std::sinh(d)))) << x;
    EXPECT_TRUE(std::isfinite(std::cosh(d)) || same_bits(cosh(x), static_cast<float>(std::cosh(d)))) << x;
    EXPECT_TRUE(std::isfinite(std::asinh(d)) || same_bits(asinh(x), static_cast<float>(std::asinh(d)))) << x;
    EXPECT_TRUE(std::isfinite(std::acosh(d)) || same_bits(acosh(x), static_cast<float>(std::acosh(d)))) << x;
    EXPECT_TRUE(std::isfinite(std::atanh(d)) || same_bits(atanh(x), static_cast<float>(std::atanh(d)))) << x;
    EXPECT_TRUE(std::isfinite(std::tan(d)) || same_bits(tan(x), static_cast<float>(std::tan(d)))) << x;
    if (std::fabs(x) < 0.5f) {  // zeros and subnormals keep every bit
      for (const float y : {sinh(x), tanh(x), asinh(x), atanh(x), tan(x)}) EXPECT_TRUE(same_bits(y, x)) << x << ' ' << y;
    }
  }
  EXPECT_EQ(tanh(kInf), 1.0f);
  EXPECT_EQ(tanh(-kInf), -1.0f);
  EXPECT_TRUE(std::isnan(tanh(kNaN)));
  EXPECT_EQ(cosh(0.0f), 1.0f);
  EXPECT_EQ(acosh(1.0f), 0.0f);
  EXPECT_EQ(sinh(89.0f) < kInf, true);
  EXPECT_EQ(sinh(90.0f), kInf);
  EXPECT_EQ(sinh(0.5), std::sinh(0.5));  // of double: the functions of std
}

TEST(LaneHyperbolic, LanesMatchScalarBits) {
  expect_glsl_lanes_match_scalars([](const auto& a, auto& out) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto x = a.x[k];
      for (const auto& y : {sinh(x), cosh(x), tanh(x), asinh(x), acosh(x), atanh(x), tan(x)}) out.add(y);
    }
  });
}

/// Detects differences between compilers, optimization levels and CPUs.
TEST(LaneHyperbolic, MatchesTheCommittedHash) {
  Hash hash;
  for (uint32_t pattern = 0, n = 0; n < 1u << 16; ++n, pattern += 65497) {
    const float x = as_real(static_cast<int32_t>(pattern)), y = static_cast<float>(static_cast<int32_t>(n) - (1 << 15)) * 0x1p-9f;
    for (const float v : {tan(y), sinh(y), cosh(y), tanh(y), asinh(x), acosh(abs(x)), atanh(y * 0x1p-6f), mod(x, y)}) {
      hash.add(std::isnan(v) ? 0x7fc00000u : static_cast<uint32_t>(as_int(v)));
    }
  }
  expect_hash("lane-hyperbolic", hash.value());
}

}  // namespace
}  // namespace halfspace
