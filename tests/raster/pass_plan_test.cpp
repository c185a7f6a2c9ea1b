// SPDX-License-Identifier: Apache-2.0
//
// How the work of a pass is divided into vertex tasks and chunks. The plan only depends on the draws, so no pass is run.
#include "halfspace/raster/loop/pass_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <numeric>
#include <vector>

#include "halfspace/raster/primitives/primitive_assembly.h"
#include "halfspace/raster/primitives/setup.h"

namespace halfspace {

namespace {

// The draws of a pass, and their plan.
struct Planned {
  explicit Planned(uint32_t chunk_triangles = kMaxPrimitivesPerChunk) : plan(1, chunk_triangles) {}

  void add(std::size_t triangles, uint32_t instances = 1) {
    DrawState& state = states.emplace_back();
    state.instances = instances;
    Draw& d =
        draws.emplace_back(kernels, KeptShader(nullptr, [](const void*) {}),
                           std::make_shared<const Indices>(Indices::sequential(3 * triangles)), VertexStreams{}, state, DrawPlacement{});
    d.vertex_count = 3 * triangles * instances;
    count_primitives(d);
    plan.add(d, draws.size() - 1);
  }

  // Numbers of primitives of the chunks.
  std::vector<uint32_t> chunk_sizes() const {
    std::vector<uint32_t> sizes;
    for (const std::vector<DrawRange>& ranges : plan.chunks) {
      sizes.push_back(std::accumulate(ranges.begin(), ranges.end(), 0u, [](uint32_t n, const DrawRange& r) { return n + r.count; }));
    }
    return sizes;
  }

  ShaderKernels kernels;
  std::deque<DrawState> states;  // the draws refer to them
  std::vector<Draw> draws;
  PassPlan plan;
};

constexpr std::size_t kVerticesPerTask = 8 * kVertexBatch;

TEST(PassPlan, SmallDrawsShareAVertexTask) {
  Planned p;
  for (int i = 0; i < 3; ++i) p.add(100);
  ASSERT_EQ(p.plan.vertex_tasks.size(), 1u);
  const VertexTask& task = p.plan.vertex_tasks[0];
  EXPECT_FALSE(task.is_part);
  EXPECT_EQ(task.draw, 0u);
  EXPECT_EQ(task.end_draw, 3u);
  EXPECT_EQ(task.end, 900u);
}

TEST(PassPlan, ALargeDrawIsDividedIntoVertexTasks) {
  Planned p;
  p.add(10);
  p.add(kVerticesPerTask);  // three tasks
  p.add(10);
  ASSERT_EQ(p.plan.vertex_tasks.size(), 5u);
  std::size_t next = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    const VertexTask& task = p.plan.vertex_tasks[i];
    EXPECT_TRUE(task.is_part);
    EXPECT_EQ(task.draw, 1u);
    EXPECT_EQ(task.begin, next);
    next = task.end;
  }
  EXPECT_EQ(next, 3 * kVerticesPerTask);
  EXPECT_FALSE(p.plan.vertex_tasks[4].is_part);
}

TEST(PassPlan, ChunksContainEachPrimitiveOnceInOrder) {
  Planned p;
  p.add(3000, 2);
  p.add(5);
  std::vector<DrawRange> expected{{0, 0, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}};  // the next primitive of each instance of each draw
  std::size_t at = 0;
  for (const std::vector<DrawRange>& ranges : p.plan.chunks) {
    for (const DrawRange& r : ranges) {
      while (at < expected.size() && (expected[at].draw != r.draw || expected[at].instance != r.instance)) ++at;
      ASSERT_LT(at, expected.size()) << "draw " << r.draw << ", instance " << r.instance << " is out of order";
      EXPECT_EQ(r.first, expected[at].first);
      expected[at].first += r.count;
    }
  }
  EXPECT_EQ(expected[0].first, 3000u);
  EXPECT_EQ(expected[1].first, 3000u);
  EXPECT_EQ(expected[2].first, 5u);
}

TEST(PassPlan, ChunksGrowWithThePass) {
  Planned p;
  p.add(200000);
  const std::vector<uint32_t> sizes = p.chunk_sizes();
  EXPECT_EQ(sizes.front(), 2048u);
  // Clipping can turn each triangle into several, and all of them must fit.
  EXPECT_EQ(*std::max_element(sizes.begin(), sizes.end()), kMaxTrianglesPerChunk / max_triangles_per_primitive(p.draws[0], 1));
  EXPECT_TRUE(std::is_sorted(sizes.begin(), sizes.end() - 1));  // the last one contains the rest
  EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), 0u), 200000u);
}

TEST(PassPlan, ChunksHaveAtMostTheGivenNumberOfPrimitives) {
  Planned p(7);
  p.add(20);
  EXPECT_EQ(p.chunk_sizes(), (std::vector<uint32_t>{7, 7, 6}));
}

TEST(PassPlan, ADrawWithoutPrimitivesNeedsNoChunk) {
  Planned p;
  p.add(0);
  EXPECT_TRUE(p.plan.chunks.empty());
}

TEST(PassPlan, KnowsTheSubmittedVerticesAndTheQueries) {
  Planned p;
  p.add(4, 3);
  EXPECT_EQ(p.plan.submitted.vertices_in, 36u);
  EXPECT_EQ(p.plan.submitted.vertices_shaded, 36u);
  EXPECT_TRUE(p.plan.submitted.queries.empty());
  p.states[0].query = 2;
  p.plan.add(p.draws[0], 1);
  EXPECT_EQ(p.plan.submitted.queries.size(), 3u);
}

}  // namespace

}  // namespace halfspace
