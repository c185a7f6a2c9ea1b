// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "halfspace/core/lane_pairs.h"
#include "halfspace/shading/shadow/shadow_blocks.h"
#include "halfspace/shading/shadow/shadow_filter.h"

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

ShadowView view_of(const Image<float>& depths, const Image<float>* blocks) {
  ShadowView view;
  view.size = depths.width();
  view.depth = depths.data();
  view.block_depths = blocks == nullptr ? nullptr : blocks->data();
  return view;
}

// Whether box_pcf<7> reads no texels.
template <class R>
bool decided_by_blocks(const ShadowView& view, const ShadowCoordinates<R>& p) {
  return all(is_lit_by_blocks(view, p, truncate_to_int(floor(p.x - R(3.5f))), truncate_to_int(floor(p.y - R(3.5f))), 4.0f));
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
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f), slope(-0.05f, 0.05f);
  const Workers workers(1);
  int decided = 0, lit = 0, count = 0;
  for (int map = 0; map < 40; ++map) {
    const int size = 40 + map;
    const Image<float> depths = occluders(size, random), blocks = shadow_block_depths(depths, workers);
    const ShadowView plain = view_of(depths, nullptr), with_blocks = view_of(depths, &blocks);
    // Points that are at least `margin` texels from the border of the map, as `holds` ensures.
    const auto point = [&](float margin, bool flat) {
      const float range = static_cast<float>(size) - 2.0f * margin;
      return ShadowCoordinates<float>{margin + range * unit(random), margin + range * unit(random), unit(random), 1.0f,
                                      flat ? 0.0f : slope(random),   flat ? 0.0f : slope(random)};
    };
    for (int i = 0; i < 500; ++i) {
      const ShadowCoordinates<float> p = point(4.0f, i % 2 == 0), q = point(3.0f, i % 2 == 0);
      const float expected = box_pcf<7>(plain, p);
      EXPECT_EQ(box_pcf<7>(with_blocks, p), expected);
      EXPECT_EQ(box_pcf<5>(with_blocks, q), box_pcf<5>(plain, q));
      const bool by_blocks = decided_by_blocks(with_blocks, p);
      EXPECT_TRUE(!by_blocks || expected > 0.999f);
      decided += by_blocks;
      lit += expected > 0.999f;
      ++count;
    }
  }
  std::printf("%d points: %d are lit, %d of them are decided by blocks\n", count, lit, decided);
  EXPECT_GT(decided, lit / 4) << "the bounds are so wide that they are useless";
  EXPECT_LT(lit, count) << "no point is in shadow";
}

// The plane of the point passes close to an occluder, in front of it or behind it at the outermost texels. Some points are almost 4 texels
// away from the center of the outermost texel.
TEST(ShadowBlocks, BoundsAreConservativeForPlanesThatTouchAnOccluder) {
  constexpr int kSize = 32;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> slope(-0.01f, 0.01f), reach(2.5f, 4.5f), offset(-1e-6f, 1e-6f), at(12.0f, 20.0f);
  Image<float> depths(kSize, kSize);
  for (int y = 0; y < kSize; ++y) std::ranges::fill(depths.row(y), 0.5f);
  const Image<float> blocks = shadow_block_depths(depths, Workers(1));
  const ShadowView plain = view_of(depths, nullptr), with_blocks = view_of(depths, &blocks);
  int decided = 0, shadowed = 0;
  for (int i = 0; i < 20000; ++i) {
    ShadowCoordinates<float> p{at(random), at(random), 0.0f, 1.0f, slope(random), slope(random)};
    if (i % 2 == 0) p.x = std::floor(p.x) + 0.5f + 0x1p-10f;
    if (i % 4 == 0) p.y = std::floor(p.y) + 0.5f + 0x1p-10f;
    p.depth = 0.5f + (i % 3 == 0 ? 4.0f : reach(random)) * (std::fabs(p.depth_dx) + std::fabs(p.depth_dy)) + offset(random);
    decided += static_cast<int>(decided_by_blocks(with_blocks, p));
    const float expected = box_pcf<7>(plain, p);
    shadowed += static_cast<int>(expected < 0.9999f);
    ASSERT_EQ(box_pcf<7>(with_blocks, p), expected);
  }
  std::printf("%d of 20000 points are decided by blocks, %d are partly in shadow\n", decided, shadowed);
  EXPECT_GT(decided, 1000);
  EXPECT_GT(shadowed, 1000);
}

// Compares packets of neighboring points with single points. Many packets are decided by blocks.
template <class R>
void expect_scalar_filter() {
  constexpr int kSize = 64;
  std::mt19937 random(4);
  const Image<float> depths = occluders(kSize, random), blocks = shadow_block_depths(depths, Workers(1));
  const ShadowView view = view_of(depths, &blocks);
  std::uniform_real_distribution<float> at(4.0f, kSize - 8.0f);
  int decided = 0;
  for (int i = 0; i < 200; ++i) {
    R x{0}, y{0};
    const float left = at(random), low = at(random);
    for (int k = 0; k < kWidthOf<R>; ++k) {
      set_lane(x, k, left + 0.3f * static_cast<float>(k % 4));
      set_lane(y, k, low + 0.3f * static_cast<float>(k / 4));
    }
    const ShadowCoordinates<R> p{x, y, R(0.4f), R(1.0f), R(0.001f), R(0.0f)};
    const R lanes = box_pcf<7>(view, p);
    for (int k = 0; k < kWidthOf<R>; ++k)
      EXPECT_EQ(lane(lanes, k), box_pcf<7>(view, ShadowCoordinates<float>{lane(x, k), lane(y, k), 0.4f, 1.0f, 0.001f, 0.0f}));
    decided += static_cast<int>(decided_by_blocks(view, p));
  }
  EXPECT_GT(decided, 20);
}

TEST(ShadowBlocks, LanesMatchScalarBits) {
  expect_scalar_filter<Real>();
  expect_scalar_filter<FragmentReal>();
}

}  // namespace

}  // namespace halfspace
