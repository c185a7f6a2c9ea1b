// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/fixed_power.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/expected_hash.h"
#include "support/hash.h"

namespace halfspace {
namespace {

constexpr float kExponents[] = {1.0f / 2.2f, 1.0f / 2.4f, 1.0f, 0.5f, 0.9f, 0.01f};
constexpr uint32_t kBitStride = 509;  // about four million floats per exponent

TEST(FixedPower, IsWithinErrorBound) {
  for (const float y : kExponents) {
    const FixedPower power(y);
    double worst = 0;
    for (int64_t i = as_int(0x1p-126f); i < as_int(detail::kInfinity); i += kBitStride) {
      const float x = as_real(static_cast<int32_t>(i));
      const double want = std::pow(static_cast<double>(x), static_cast<double>(y));
      worst = std::max(worst, std::fabs(static_cast<double>(power(x)) - want) / want);
    }
    // Two products, two table entries and the last step of the polynomial are each rounded to 2^-24. The error is the sum of these
    // roundings and the approximation error of the polynomial.
    EXPECT_LE(worst, 3e-7) << y;
  }
}

TEST(FixedPower, HandlesZerosSubnormalsNegativesAndNaN) {
  constexpr FixedPower power(0.4f);  // must be usable in a constant expression
  EXPECT_EQ(power(0.0f), 0.0f);
  EXPECT_EQ(power(-0.0f), 0.0f);
  EXPECT_EQ(power(0x1p-127f), 0.0f);
  EXPECT_TRUE(std::isnan(power(-1.0f)));
  EXPECT_TRUE(std::isnan(power(detail::kNaN)));
  EXPECT_EQ(power(0.25), pow(0.25, static_cast<double>(0.4f)));
}

template <int W>
void expect_bits_of_float(const FixedPower& power) {
  uint32_t pattern = 1;
  for (int n = 0; n < 1 << 16; ++n) {
    RealN<W> x;
    for (int k = 0; k < W; ++k, pattern += 2654435761u) set_lane(x, k, as_real(static_cast<int32_t>(pattern)));
    const RealN<W> got = power(x);
    for (int k = 0; k < W; ++k) {
      const float want = power(lane(x, k));
      if (std::isnan(want) && std::isnan(lane(got, k))) continue;
      ASSERT_EQ(as_int(lane(got, k)), as_int(want)) << "width " << W << ", " << lane(x, k);
    }
  }
}

TEST(FixedPower, LanesMatchScalarBits) {
  const FixedPower power(1.0f / 2.2f);
  expect_bits_of_float<4>(power);
  expect_bits_of_float<8>(power);
  expect_bits_of_float<16>(power);
}

/// The hash changes if a compiler or processor computes different tables.
TEST(FixedPower, MatchesTheCommittedHash) {
  Hash hash;
  for (const float y : kExponents) {
    const FixedPower power(y);
    for (int64_t i = as_int(0x1p-126f); i < as_int(detail::kInfinity); i += 100 * kBitStride) {
      hash.add(static_cast<uint32_t>(as_int(power(as_real(static_cast<int32_t>(i))))));
    }
  }
  expect_hash("fixed-power", hash.value());
}

}  // namespace
}  // namespace halfspace
