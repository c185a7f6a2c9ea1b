// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/normal_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/workers.h"

namespace halfspace {
namespace {

template <class F>
Image<float> heights_of(int width, int height, F value) {
  Image<float> map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) map.at(x, y) = static_cast<float>(value(x, y));
  }
  return map;
}

glm::dvec3 decoded(const glm::u8vec4& t) { return glm::dvec3(t.x, t.y, t.z) / 255.0 * 2.0 - 1.0; }

// Half a quantization step (half an LSB) after decoding to [−1, 1].
constexpr double kHalfCode = 1.0 / 255.0;

// h = 1/2 + A·sin φ with φ = a·x + b·y in texels. The difference over two texels is A·cos φ·sin a, and averaging across the other axis
// multiplies it by (4 + 2·cos b)/6. Rounding to float changes a height by up to 3e-8, which changes a slope by up to 1e-6 at strength 30.
TEST(NormalMap, WavesMatchTheClosedForm) {
  const int width = 48, height = 32;
  for (const auto& [along_x, along_y] : {std::pair(1, 0), std::pair(0, 3), std::pair(2, 1), std::pair(-5, 4)}) {
    const double a = 2 * std::numbers::pi * along_x / width, b = 2 * std::numbers::pi * along_y / height, amplitude = 0.4, strength = 30;
    const Image<float> heights = heights_of(width, height, [&](int x, int y) { return 0.5 + amplitude * std::sin(a * x + b * y); });
    const Image<glm::u8vec4> map = normal_map(heights, strength, MapEdges::torus, two_workers());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double cosine = std::cos(a * x + b * y);
        const double dx = amplitude * cosine * std::sin(a) * (4 + 2 * std::cos(b)) / 6;
        const double dy = amplitude * cosine * std::sin(b) * (4 + 2 * std::cos(a)) / 6;
        const glm::dvec3 n = glm::normalize(glm::dvec3(-strength * dx, strength * dy, 1));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(decoded(map.at(x, y))[c], n[c], kHalfCode + 1e-5) << x << " " << y;
        EXPECT_EQ(map.at(x, y).w, 255);
      }
    }
  }
}

// The relative difference from the slope of the wave is at most a²/6 + b²/6. For a wavelength of 48 texels that is 0.3% per axis.
TEST(NormalMap, LongWavesMatchTheirSlope) {
  const int n = 48;
  const double a = 2 * std::numbers::pi / n;
  const Image<glm::u8vec4> map =
      normal_map(heights_of(n, 8, [&](int x, int) { return 0.5 + 0.5 * std::sin(a * x); }), 10, MapEdges::torus, two_workers());
  for (int x = 0; x < n; ++x) {
    const double slope = 10 * 0.5 * a * std::cos(a * x);
    EXPECT_NEAR(decoded(map.at(x, 3)).x, -slope / std::sqrt(slope * slope + 1), kHalfCode + 0.003 * std::abs(slope) + 1e-9) << x;
  }
}

// A ramp that rises by one texel per texel, that is, at 45°. A ramp that rises to the right tilts the normal to the left; one that rises
// upwards tilts it down.
TEST(NormalMap, SignsAndUnitsAreCorrect) {
  const double side = std::sqrt(0.5);
  const auto center = [](const Image<float>& heights) { return decoded(normal_map(heights, 16, MapEdges::sheet, two_workers()).at(8, 8)); };
  const glm::dvec3 right = center(heights_of(17, 17, [](int x, int) { return x / 16.0; }));
  const glm::dvec3 up = center(heights_of(17, 17, [](int, int y) { return 1 - y / 16.0; }));
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(right[c], glm::dvec3(-side, 0, side)[c], kHalfCode);
    EXPECT_NEAR(up[c], glm::dvec3(0, -side, side)[c], kHalfCode);
  }
  EXPECT_EQ(normal_map(heights_of(4, 4, [](int, int) { return 0.3; }), 100, MapEdges::torus, two_workers()).at(1, 1),
            glm::u8vec4(128, 128, 255, 255));
}

// The step between opposite edges is visible if the map repeats, and invisible if it does not.
TEST(NormalMap, RespectsTheEdgeMode) {
  const Image<float> ramp = heights_of(16, 16, [](int x, int y) { return (x + y) / 32.0; });
  const auto at = [&](MapEdges edges, int x, int y) { return decoded(normal_map(ramp, 8, edges, two_workers()).at(x, y)); };
  EXPECT_GT(at(MapEdges::torus, 0, 8).x, 0.3) << "the left neighbor of column 0 is the highest column";
  EXPECT_LT(at(MapEdges::sheet, 0, 8).x, 0);
  EXPECT_LT(at(MapEdges::torus, 8, 0).y, -0.3);
  EXPECT_GT(at(MapEdges::sheet, 8, 0).y, 0);
}

TEST(NormalMap, IsBitIdenticalForAnyThreadCount) {
  const Image<float> heights = heights_of(37, 23, [](int x, int y) { return (x * 7 + y * y * 3) % 11 / 10.0; });
  EXPECT_TRUE(normal_map(heights, 3, MapEdges::torus, Workers(1)) == normal_map(heights, 3, MapEdges::torus, Workers(5)));
}

}  // namespace
}  // namespace halfspace
