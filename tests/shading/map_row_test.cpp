// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/texture/map_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace halfspace {
namespace {

// Compares reads at every start position, from far left to far right of a row, with individually clamped columns. Lanes are all inside, all
// outside or mixed, and some maps are narrower than four columns. The buffer ends with the last texel of the row, so a sanitizer detects
// reads past it.
template <int N, class R>
void expect_clamped_rows() {
  for (const int width : {1, 2, 3, 4, 5, 40}) {
    std::vector<float> map(static_cast<std::size_t>(3 * width));
    for (std::size_t i = 0; i < map.size(); ++i) map[i] = static_cast<float>(i);
    for (int start = -6; start <= width + 6; ++start) {
      for (const int step : {0, 1}) {
        for (const int row : {0, 2}) {
          IntOf<R> i(0);
          for (int k = 0; k < kWidthOf<R>; ++k) set_lane(i, k, start + step * k);
          const std::array<R, N> texels = map_row<N, R>(map.data(), width, i, IntOf<R>(row));
          for (int n = 0; n < N; ++n) {
            for (int k = 0; k < kWidthOf<R>; ++k) {
              const int column = std::clamp(start + step * k + n, 0, width - 1);
              ASSERT_EQ(lane(texels[static_cast<std::size_t>(n)], k), static_cast<float>(row * width + column))
                  << width << ' ' << start << ' ' << step << ' ' << row << ' ' << n << ' ' << k;
            }
          }
        }
      }
    }
  }
}

TEST(MapRow, ClampsColumnsOutsideTheMap) {
  expect_clamped_rows<1, float>();
  expect_clamped_rows<3, double>();
  expect_clamped_rows<2, RealN<4>>();
  expect_clamped_rows<3, RealN<8>>();
  expect_clamped_rows<4, RealN<16>>();
  expect_clamped_rows<4, FragmentReal>();
}

}  // namespace
}  // namespace halfspace
