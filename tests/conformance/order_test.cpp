// SPDX-License-Identifier: Apache-2.0
//
// Blending depends on the drawing order: a hundred thousand translucent points must always be drawn in submission order.
//
// HALFSPACE_RUNS=n   runs n times with each number of threads instead of 3 (scripts/test_full.sh: 100)
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "conformance/geometry.h"

namespace halfspace::conformance {

namespace {

Picture blended_particles() {
  Picture p;
  p.width = 256;
  p.height = 128;
  p.colors = {ColorFormat::rgba16f};
  Drawing d;
  d.kind = Kind::point;
  d.state.topology = Topology::points;
  d.state.depth.test = false;
  d.state.blend.emplace();
  d.vertices = scattered(p, 100000, 9);
  for (std::size_t i = 0; i < d.vertices.size(); ++i) {
    d.vertices[i].color.w = 0.5f;
    d.vertices[i].extra.x = 1.0f + static_cast<float>(i % 7);
  }
  p.draws.push_back(std::move(d));
  return p;
}

}  // namespace

TEST(ConformanceOrder, BlendedParticlesAreBitIdenticalForAnyThreadCount) {
  const char* text = std::getenv("HALFSPACE_RUNS");
  const int runs = text == nullptr ? 3 : std::atoi(text);
  const Picture picture = blended_particles();
  const Seen first = draw(picture);
  for (const int threads : {1, 2, 64}) {
    for (int i = 0; i < runs; ++i) ASSERT_EQ(draw(picture, {}, threads).bytes, first.bytes) << threads << " threads, run " << i;
  }
  // The reverse order gives a different picture, so the test can detect errors.
  Picture turned = picture;
  std::reverse(turned.draws[0].vertices.begin(), turned.draws[0].vertices.end());
  EXPECT_NE(draw(turned).bytes, first.bytes);
  RecordProperty("runs", std::to_string(3 * runs));
}

}  // namespace halfspace::conformance
