// SPDX-License-Identifier: Apache-2.0
//
// Tests parts of the state with the naive pipeline: its pictures in float are those of a pass, bit for bit.
#include "halfspace/raster/naive.h"

#include <cstring>

#include "raster/raster_test.h"

namespace halfspace::raster_test::naive_test {
namespace {

constexpr int kWidth = 70, kHeight = 45;

struct Mesh {
  std::vector<glm::vec4> positions, colors;
  auto view() const { return make_vertex_view(stream(positions), stream(colors)); }
};

Mesh heap(uint64_t seed, int triangles) {
  Random random(seed);
  Mesh m;
  for (int i = 0; i < triangles * 3; ++i) {
    const auto number = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
    m.positions.push_back({number(-1.2, 1.2), number(-1.2, 1.2), number(-0.9, 0.9), number(0.8, 1.5)});
    m.colors.push_back({number(0, 1), number(0, 1), number(0, 1), 1});
  }
  return m;
}

// Draws one mesh, and another one with the state.
void expect_same(const DrawState& state) {
  const Mesh first = heap(1, 30), second = heap(2, 60);
  Image<glm::vec4> color(kWidth, kHeight);
  Image<float> depth(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(color), d32f_target(depth));
  NaiveTarget<float> naive(kWidth, kHeight, vec4<float>(0.0f), 1.0f);
  for (const auto& [mesh, with] : {std::pair(&first, DrawState{}), {&second, state}}) {
    pass.draw(SmoothColorShader{}, mesh->view(), with);
    draw_naive(naive, SmoothColorShader{}, mesh->view(), Indices::sequential(mesh->positions.size()), with);
  }
  const PassStatistics statistics = pass.run(one_worker());
  EXPECT_GT(statistics.samples_passed, 500u);
  EXPECT_EQ(std::memcmp(color.data(), naive.color.data(), sizeof(glm::vec4) * kWidth * kHeight), 0);
  EXPECT_EQ(depth, naive.depth);
}

TEST(Naive, OffsetsPolygons) {
  for (const float slope : {-1.5f, 0.0f, 2.0f}) {
    for (const float constant : {-300000.0f, 0.0f, 4.0f}) {
      expect_same({.offset = {.slope = slope, .constant = constant}});
      expect_same({.offset = {.slope = slope, .constant = constant, .clamp = slope < 0.0f ? -0.01f : 0.01f}});
    }
  }
}

TEST(Naive, TestsTheBoundsOfTheStoredDepth) {
  for (const auto& [low, high] : {std::pair(0.2f, 0.6f), {0.5f, 1.0f}, {0.0f, 0.4f}, {1.0f, 1.0f}}) {
    expect_same({.depth_bounds = StoredDepthRange{low, high}});
    expect_same({.depth = {.compare = CompareOp::greater}, .depth_bounds = StoredDepthRange{low, high}});
  }
}

}  // namespace
}  // namespace halfspace::raster_test::naive_test
