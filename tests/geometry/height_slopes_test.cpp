// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/height_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace halfspace {
namespace {

TEST(HeightSlopes, MatchTheSlopeOfAWave) {
  // h = sin 2πku · cos 2πlv. The slope of the parabola is the true slope times the sinc of the wave's step, 1 − (2πk/w)²/6.
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
      // Heights are floats with an error of 6e-8, and the slope divides their difference by a step of 2/64.
      EXPECT_NEAR(s.at(x, y).x, tau * 2 * std::cos(u) * std::cos(v) * std::sin(ku) / ku, 5e-6);
      EXPECT_NEAR(s.at(x, y).y, -tau * std::sin(u) * std::sin(v) * std::sin(kv) / kv, 5e-6);
    }
  }
}

TEST(HeightSlopes, EdgesFollowTheWrapMode) {
  Image<float> ramp(4, 1);
  for (int x = 0; x < 4; ++x) ramp.at(x, 0) = static_cast<float>(x);
  const auto left = [&](Wrap wrap) { return height_slopes(ramp, wrap, Wrap::clamp).at(0, 0).x; };
  EXPECT_EQ(left(Wrap::clamp), 4.0f) << "a rise of 1 over a quarter of the map";
  EXPECT_EQ(left(Wrap::border), 4.0f);
  EXPECT_EQ(left(Wrap::repeat), -4.0f) << "from 3 at the opposite edge to 1, over two texels";
  EXPECT_EQ(left(Wrap::mirrored), 2.0f) << "the height beyond the edge equals the edge texel";
  EXPECT_EQ(height_slopes(ramp, Wrap::clamp, Wrap::clamp).at(2, 0).x, 4.0f);
  EXPECT_EQ(height_slopes(ramp, Wrap::clamp, Wrap::clamp).at(3, 0).x, 4.0f);
  EXPECT_EQ(height_slopes(ramp, Wrap::clamp, Wrap::repeat).at(1, 0).y, 0.0f) << "a single row has no slope";
}

TEST(HeightSlopes, EncodedSlopesAreRoundedAndClamped) {
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
