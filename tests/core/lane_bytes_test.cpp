// SPDX-License-Identifier: Apache-2.0
//
// Compares the arithmetic on the bytes of lanes with that of single integers. lanes_test.cpp tests loads and stores.
#include "halfspace/core/lane_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace halfspace {
namespace {

// Returns byte k of all lanes.
int byte_at(Int i, int k) { return lane(i, k / 4) >> (8 * (k % 4)) & 0xff; }

}  // namespace

TEST(LaneBytes, ArithmeticIsExactForAllPairs) {
  constexpr int kBytes = 4 * kLanes;
  for (int a = 0; a < 256; ++a) {
    for (int first = 0; first < 256; first += kBytes) {
      const Int x(static_cast<int32_t>(static_cast<uint32_t>(a) * 0x01010101u));
      Int y(0);
      for (int i = 0; i < kLanes; ++i)
        set_lane(y, i, static_cast<int32_t>(0x03020100u + static_cast<uint32_t>(first + 4 * i) * 0x01010101u));
      for (int k = 0; k < kBytes; ++k) {
        const int b = first + k;
        ASSERT_EQ(byte_at(y, k), b);
        ASSERT_EQ(byte_at(min_bytes(x, y), k), std::min(a, b));
        ASSERT_EQ(byte_at(max_bytes(x, y), k), std::max(a, b));
        ASSERT_EQ(byte_at(add_bytes(x, y), k), std::min(a + b, 255));
        ASSERT_EQ(byte_at(subtract_bytes(x, y), k), std::max(a - b, 0));
      }
    }
  }
}

}  // namespace halfspace
