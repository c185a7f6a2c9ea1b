// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/shadow/moment_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace halfspace {
namespace {

ShadowView view_of(int size, bool perspective) {
  ShadowView view;
  view.size = size;
  view.perspective = perspective;
  view.near = 0.5f;
  view.far = 8.0f;
  view.depth_per_unit = perspective ? view.near * view.far / (view.far - view.near) : 1.0f / (view.far - view.near);
  return view;
}

TEST(MomentMap, StoresMeanPowersOverASquare) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(0.0f, 1.0f);
  // Some sizes are not multiples of the rows per task or of the SIMD width.
  for (const glm::ivec2& c : {glm::ivec2(256, 2), glm::ivec2(301, 0), glm::ivec2(257, 5)}) {
    const int size = c.x, radius = c.y;
    for (const bool perspective : {false, true}) {
      const ShadowView view = view_of(size, perspective);
      Image<float> depth(size, size);
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) depth.at(x, y) = any(random);
      const Image<glm::vec4> map = filtered_moments(view, depth, radius, Workers(3));
      EXPECT_EQ(map, filtered_moments(view, depth, radius, Workers(1)));
      const auto linear = [&](int x, int y) {
        const double z = static_cast<double>(depth.at(std::clamp(x, 0, size - 1), std::clamp(y, 0, size - 1)));
        if (!perspective) return 1.0 - z;
        const double w = 4.0 / 7.5 / (z + 0.5 / 7.5);  // z = (near·far/w − near) / (far − near)
        return (w - 0.5) / 7.5;
      };
      for (int k = 0; k < 500; ++k) {
        // Includes texels at the borders.
        const int x = k % 3 == 0 ? k % 7 : static_cast<int>(random() % static_cast<unsigned>(size)),
                  y = k % 5 == 0 ? size - 1 - k % 4 : static_cast<int>(random() % static_cast<unsigned>(size));
        glm::dvec4 sum(0.0);
        for (int j = -radius; j <= radius; ++j) {
          for (int i = -radius; i <= radius; ++i) {
            const double d = linear(x + i, y + j);
            sum += glm::dvec4(d, d * d, d * d * d, d * d * d * d);
          }
        }
        sum /= (2 * radius + 1) * (2 * radius + 1);
        for (int n = 0; n < 4; ++n)
          ASSERT_NEAR(map.at(x, y)[n], sum[n], 2e-6) << size << ' ' << radius << ' ' << x << ' ' << y;  // sums of 22 floats
      }
    }
  }
}

}  // namespace
}  // namespace halfspace
