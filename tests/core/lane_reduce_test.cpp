// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/lane_reduce.h"

#include <gtest/gtest.h>

#include <limits>

namespace halfspace {
namespace {

template <class R>
class LaneReduce : public testing::Test {};
using ReducedWidths = testing::Types<float, RealN<4>, RealN<8>, RealN<16>>;
TYPED_TEST_SUITE(LaneReduce, ReducedWidths);

TYPED_TEST(LaneReduce, FindsTheExtremeInEveryLane) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  for (int k = 0; k < kWidthOf<TypeParam>; ++k) {
    for (const float extreme : {3.0f, inf}) {
      TypeParam v(1.0f);
      set_lane(v, k, extreme);
      EXPECT_EQ(max_lane(v), extreme);
      EXPECT_EQ(min_lane(-v), -extreme);
    }
  }
}

}  // namespace
}  // namespace halfspace
