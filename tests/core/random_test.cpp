// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/random.h"

#include <gtest/gtest.h>

namespace halfspace {
namespace {

// The first outputs of the reference implementation, https://prng.di.unimi.it/splitmix64.c, for the seed 1234567.
TEST(SplitMix64, MatchesTheReferenceImplementation) {
  SplitMix64 random(1234567);
  for (const uint64_t expected : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u, 4593380528125082431u})
    EXPECT_EQ(random.next(), expected);
}

TEST(SplitMix64, RealNumbersUseTheHighBits) {
  SplitMix64 bits(5), floats(5), doubles(5);
  for (int i = 0; i < 1000; ++i) {
    const uint64_t next = bits.next();
    EXPECT_EQ(floats.real(0.0f, 1.0f), static_cast<float>(next >> 40) / 16777216.0f);
    EXPECT_EQ(doubles.real(0.0, 1.0), static_cast<double>(next >> 11) / 9007199254740992.0);
  }
}

TEST(SplitMix64, RealNumbersAreInTheInterval) {
  SplitMix64 random(6);
  double sum = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const float x = random.real(-3.0f, 5.0f);
    const double y = random.real(-3.0, 5.0);
    ASSERT_TRUE(x >= -3.0f && x < 5.0f && y >= -3.0 && y < 5.0) << x << ' ' << y;
    sum += y;
  }
  EXPECT_NEAR(sum / 10000, 1.0, 0.1);
}

}  // namespace
}  // namespace halfspace
