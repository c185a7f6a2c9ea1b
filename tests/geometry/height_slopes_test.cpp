// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/height_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace halfspace {
namespace {

TEST(HeightSlopes, FollowAWave) {
  // h = sin 2πku · cos 2πlv: the parabola's slope is the true one times sinc of the wave's step, 1 − (2πk/w)²/6.
  constexpr int kWidth = 64, kHeight = 32;
  const double tau = 2 * std::numbers::pi;
  Image<float> h(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x)
      h.at(x, y) = static_cast<float>(std::sin(tau * 2 * (x + 0.5) / kWidth) * std::cos(tau * (y + 0.5) / kHeight));
  }
  const Image<glm::vec4> s = height_slopes(h, Wrap::repeat, Wrap::repeat);
  const double ku = tau * 2 / kWidth, kv = tau / kHeight;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double u = tau * 2 * (x + 0.5) / kWidth, v = tau * (y + 0.5) / kHeight;
      // Heights are floats: 6e-8 of error over a step of 2/64, twice.
      EXPECT_NEAR(s.at(x, y).x, tau * 2 * std::cos(u) * std::cos(v) * std::sin(ku) / ku, 5e-6);
      EXPECT_NEAR(s.at(x, y).y, -tau * std::sin(u) * std::sin(v) * std::sin(kv) / kv, 5e-6);
    }
  }
}

TEST(HeightSlopes, EdgesGoByTheWrap) {
  Image<float> ramp(4, 1);
  for (int x = 0; x < 4; ++x) ramp.at(x, 0) = static_cast<float>(x);
  const auto left = [&](Wrap wrap) { return height_slopes(ramp, wrap, Wrap::clamp).at(0, 0).x; };
  EXPECT_EQ(left(Wrap::clamp), 4.0f) << "one texel up in a quarter of the map";
  EXPECT_EQ(left(Wrap::border), 4.0f);
  EXPECT_EQ(left(Wrap::repeat), -4.0f) << "from 3 on the other side to 1, over two texels";
  EXPECT_EQ(left(Wrap::mirrored), 2.0f) << "beyond the edge lies the same height again";
  EXPECT_EQ(height_slopes(ramp, Wrap::clamp, Wrap::clamp).at(2, 0).x, 4.0f);
  EXPECT_EQ(height_slopes(ramp, Wrap::clamp, Wrap::clamp).at(3, 0).x, 4.0f);
  EXPECT_EQ(height_slopes(ramp, Wrap::clamp, Wrap::repeat).at(1, 0).y, 0.0f) << "one row";
}

TEST(HeightSlopes, CodesAreRoundedAndHeld) {
  Image<float> h(4, 1);
  h.at(0, 0) = -1.0f;
  h.at(1, 0) = 0.5f;
  h.at(2, 0) = 1.0f;
  h.at(3, 0) = 2.0f;
  const Image<uint16_t> c = codes16(h);
  EXPECT_EQ(c.at(0, 0), 0);
  EXPECT_EQ(c.at(1, 0), 32768);
  EXPECT_EQ(c.at(2, 0), 65535);
  EXPECT_EQ(c.at(3, 0), 65535);
}

}  // namespace
}  // namespace halfspace
