// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/lane_packing.h"

#include <gtest/gtest.h>

#include <random>

namespace halfspace {
namespace {

template <class I>
class LanePacking : public testing::Test {};
using Widths = testing::Types<int32_t, IntN<4>, IntN<8>, IntN<16>>;
TYPED_TEST_SUITE(LanePacking, Widths);

// All masks of up to eight lanes, and random ones of 16.
template <int width>
std::vector<uint32_t> masks() {
  std::mt19937 random(1);
  std::vector<uint32_t> all;
  for (uint32_t i = 0; i < 1u << std::min(width, 8); ++i) all.push_back(i);
  for (int i = 0; width == 16 && i < 1000; ++i) all.push_back(random() & 0xffff);
  return all;
}

TYPED_TEST(LanePacking, MovesLanesToTheFrontAndBack) {
  using R = std::conditional_t<std::is_same_v<TypeParam, int32_t>, float, RealN<sizeof(TypeParam) == 4 ? 4 : sizeof(TypeParam) / 4>>;
  constexpr int width = sizeof(TypeParam) / sizeof(int32_t);
  TypeParam numbers{};
  for (int i = 0; i < width; ++i) set_lane(numbers, i, 100 + i);
  for (const uint32_t mask : masks<width>()) {
    const TypeParam packed = pack_lanes(numbers, mask);
    R values{};
    for (int k = 0; k < std::popcount(mask); ++k) set_lane(values, k, static_cast<float>(lane(packed, k)));
    const R back = unpack_lanes(values, mask);
    int k = 0;
    for (int i = 0; i < width; ++i) {
      if ((mask >> i & 1) == 0) continue;
      ASSERT_EQ(lane(packed, k++), 100 + i) << "mask " << mask;
      ASSERT_EQ(lane(back, i), static_cast<float>(100 + i)) << "mask " << mask;
    }
  }
}

TEST(LanePacking, MovesBitsToTheSetLanes) {
  EXPECT_EQ(unpack_bits(0b101, 0b10110), 0b10010u);
  EXPECT_EQ(unpack_bits(0b1010, 0b10110), 0b00100u);  // the fourth bit belongs to no lane
  EXPECT_EQ(unpack_bits(0xffff, 0), 0u);
}

}  // namespace
}  // namespace halfspace
