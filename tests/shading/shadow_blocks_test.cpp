// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "halfspace/core/lanes.h"
#include "halfspace/shading/shadow_blocks.h"
#include "halfspace/shading/shadow_filter.h"

namespace halfspace {

namespace {

// A map with rectangles of random depths, empty elsewhere.
Image<float> occluders(int size, std::mt19937& random) {
  Image<float> depth(size, size);
  const auto number = [&](int below) { return static_cast<int>(random() % static_cast<uint32_t>(below)); };
  for (int n = 0; n < 12; ++n) {
    const int x0 = number(size), y0 = number(size), x1 = std::min(x0 + 1 + number(12), size), y1 = std::min(y0 + 1 + number(12), size);
    const float value = static_cast<float>(number(1000)) / 1000.0f;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) depth.at(x, y) = value;
    }
  }
  return depth;
}

TEST(ShadowBlocks, HoldTheLargestDepthOfFourBlocks) {
  std::mt19937 random(1);
  for (const int size : {1, 7, 8, 20, 64}) {
    const Image<float> depth = occluders(size, random), blocks = shadow_block_depths(depth, Workers(2));
    const int side = (size + 7) / 8;
    ASSERT_EQ(blocks.width(), side);
    for (int by = 0; by < side; ++by) {
      for (int bx = 0; bx < side; ++bx) {
        float expected = 0.0f;
        for (int y = 8 * by; y < std::min(8 * by + 16, size); ++y) {
          for (int x = 8 * bx; x < std::min(8 * bx + 16, size); ++x) expected = std::max(expected, depth.at(x, size - 1 - y));
        }
        EXPECT_EQ(blocks.at(bx, by), expected) << size << ": " << bx << ", " << by;
      }
    }
  }
}

// Filters give the same bits with and without block depths, for points on planes of all slopes.
TEST(ShadowBlocks, DoNotChangeFilters) {
  constexpr int kSize = 64;
  std::mt19937 random(2);
  std::uniform_real_distribution<float> at(4.0f, kSize - 4.0f), depth(0.0f, 1.0f), slope(-0.05f, 0.05f);
  const Workers workers(1);
  int decided = 0, lit = 0, count = 0;
  for (int map = 0; map < 20; ++map) {
    const Image<float> depths = occluders(kSize, random), blocks = shadow_block_depths(depths, workers);
    ShadowView plain, with_blocks;
    plain.size = with_blocks.size = kSize;
    plain.depth = with_blocks.depth = depths.data();
    with_blocks.block_depths = blocks.data();
    for (int i = 0; i < 1000; ++i) {
      const bool flat = i % 2 == 0;
      const ShadowCoordinates<float> p{
          at(random), at(random), depth(random), 1.0f, flat ? 0.0f : slope(random), flat ? 0.0f : slope(random)};
      const float expected = box_pcf<7>(plain, p);
      EXPECT_EQ(box_pcf<7>(with_blocks, p), expected);
      EXPECT_EQ(box_pcf<5>(with_blocks, p), box_pcf<5>(plain, p));
      const int x = static_cast<int>(p.x - 3.5f), y = static_cast<int>(p.y - 3.5f);
      const bool by_blocks = is_lit_by_blocks(with_blocks, p, x, y, 4.0f);
      EXPECT_TRUE(!by_blocks || expected > 0.999f);
      decided += by_blocks;
      lit += expected > 0.999f;
      ++count;
    }
  }
  std::printf("%d points: %d are lit, %d of them are decided by blocks\n", count, lit, decided);
  EXPECT_GT(decided, lit / 3) << "the bounds are so wide that they are useless";
  EXPECT_LT(lit, count) << "no point is in shadow";
}

// The comparison of every texel of the kernel agrees with the bound when the plane passes just in front of an occluder.
TEST(ShadowBlocks, BoundsAreConservativeForPlanesThatTouchAnOccluder) {
  constexpr int kSize = 32;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> slope(-0.01f, 0.01f), offset(-1e-6f, 1e-6f), at(12.0f, 20.0f);
  int decided = 0;
  for (int i = 0; i < 20000; ++i) {
    ShadowCoordinates<float> p{at(random), at(random), 0.0f, 1.0f, slope(random), slope(random)};
    p.depth = 0.5f + 4.0f * (std::fabs(p.depth_dx) + std::fabs(p.depth_dy)) + offset(random);
    Image<float> depths(kSize, kSize);
    for (int y = 0; y < kSize; ++y) std::ranges::fill(depths.row(y), 0.5f);
    const Image<float> blocks = shadow_block_depths(depths, Workers(1));
    ShadowView plain, with_blocks;
    plain.size = with_blocks.size = kSize;
    plain.depth = with_blocks.depth = depths.data();
    with_blocks.block_depths = blocks.data();
    const int x = static_cast<int>(p.x - 3.5f), y = static_cast<int>(p.y - 3.5f);
    decided += static_cast<int>(is_lit_by_blocks(with_blocks, p, x, y, 4.0f));
    ASSERT_EQ(box_pcf<7>(with_blocks, p), box_pcf<7>(plain, p));
  }
  EXPECT_GT(decided, 0);
}

TEST(ShadowBlocks, LanesMatchScalarBits) {
  constexpr int kSize = 64;
  std::mt19937 random(4);
  const Image<float> depths = occluders(kSize, random), blocks = shadow_block_depths(depths, Workers(1));
  ShadowView view;
  view.size = kSize;
  view.depth = depths.data();
  view.block_depths = blocks.data();
  std::uniform_real_distribution<float> at(4.0f, kSize - 4.0f);
  for (int i = 0; i < 200; ++i) {
    Real x{}, y{};
    for (int k = 0; k < kLanes; ++k) {
      set_lane(x, k, at(random));
      set_lane(y, k, at(random));
    }
    const Real lanes = box_pcf<7>(view, ShadowCoordinates<Real>{x, y, Real(0.4f), Real(1.0f), Real(0.001f), Real(0.0f)});
    for (int k = 0; k < kLanes; ++k)
      EXPECT_EQ(lane(lanes, k), box_pcf<7>(view, ShadowCoordinates<float>{lane(x, k), lane(y, k), 0.4f, 1.0f, 0.001f, 0.0f}));
  }
}

}  // namespace

}  // namespace halfspace
