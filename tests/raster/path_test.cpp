// SPDX-License-Identifier: Apache-2.0
//
// The table of the paths from the bin to the visibility buffer or the queue: what it says, and the choice for each kind of draw.
#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <string>

#include "halfspace/raster/visibility/visibility.h"
#include "support/files.h"

namespace halfspace {

namespace {

void shade_nothing(const void*, const FragmentBatch&) {}
void keep_nothing(const void*, const VisibilityBatch&) {}

// A draw as PassState::add() would create it.
struct TestDraw {
  ShaderKernels kernels;
  DrawState state;
  bool deferred = true, has_stencil = true;
  DepthFormat depth_format = DepthFormat::d32f;
  int samples = 1;
  PassContext context{};
  std::unique_ptr<Tile> tile = std::make_unique<Tile>();
  std::deque<Draw> draws;  // a DrawInTile refers to its draw

  TestDraw() { kernels.fragment = shade_nothing; }

  DrawInTile in_tile() {
    tile->samples = samples;
    tile->depth_format = depth_format;
    tile->has_stencil = has_stencil;
    Draw draw(kernels, KeptShader(nullptr, [](const void*) {}), nullptr, {}, state, {});
    draw.deferred = deferred;
    draw.writes_color = true;
    draws.push_back(std::move(draw));
    return DrawInTile(context, draws.back(), visibility_mode(draws.back()), *tile);
  }
  TilePath path() { return in_tile().path; }
};

std::string name_of(TilePath path) { return std::string(path_rows()[static_cast<std::size_t>(path)].name); }

TEST(Paths, TheDocumentShowsTheTable) {
  std::string table;
  for (const PathRow& row : path_rows()) {
    EXPECT_EQ(&row, &path_rows()[static_cast<std::size_t>(row.path)]) << row.name;
    table += "| `" + std::string(row.name) + "` | " + std::string(row.decided_by) + " | " + std::string(row.depth_state) + " | " +
             std::string(row.output) + " |\n";
  }
  EXPECT_NE(read_bytes("docs/explanation/architecture.md").find(table), std::string::npos) << "expected in the document:\n" << table;
}

TEST(Paths, OpaqueDrawsAreDistinguishedByTheirDepthState) {
  TestDraw draw;
  EXPECT_EQ(name_of(draw.path()), "nearest");
  draw.samples = 4;
  EXPECT_EQ(name_of(draw.path()), "nearest");
  draw.state.depth.write = false;
  EXPECT_EQ(name_of(draw.path()), "opaque");
  draw.state.depth = {.compare = CompareOp::greater};
  EXPECT_EQ(name_of(draw.path()), "opaque");
  draw.state.depth.test = false;
  EXPECT_EQ(name_of(draw.path()), "opaque");
  draw.state.stencil = StencilState{};
  EXPECT_EQ(name_of(draw.path()), "stencil");
  draw.has_stencil = false;
  EXPECT_EQ(name_of(draw.path()), "opaque");

  TestDraw without_depth;
  without_depth.depth_format = DepthFormat::none;
  EXPECT_EQ(name_of(without_depth.path()), "opaque");
}

TEST(Paths, DrawsWhoseShaderDecidesAreQueued) {
  TestDraw blended;
  blended.deferred = false;
  EXPECT_EQ(name_of(blended.path()), "queued");
  blended.state.stencil = StencilState{};
  EXPECT_EQ(name_of(blended.path()), "queued_stencil");

  TestDraw masked;
  masked.kernels.discards = true;
  masked.kernels.visibility = keep_nothing;
  EXPECT_EQ(name_of(masked.path()), "queued_less");
  masked.samples = 4;
  EXPECT_EQ(name_of(masked.path()), "queued_less");
  masked.kernels.writes_depth = true;
  EXPECT_EQ(name_of(masked.path()), "queued");
}

TEST(Paths, TheStencilTestFollowsTheShaderIfItUpdatesValuesOfDiscardedFragments) {
  TestDraw masked;
  masked.kernels.discards = true;
  masked.kernels.visibility = keep_nothing;
  masked.state.stencil = StencilState{};
  EXPECT_EQ(name_of(masked.path()), "queued_stencil");  // the values are not updated
  EXPECT_FALSE(masked.in_tile().postpones_stencil);
  masked.state.stencil->front.pass = StencilOp::replace;
  EXPECT_EQ(name_of(masked.path()), "queued");
  EXPECT_TRUE(masked.in_tile().postpones_stencil);
  masked.has_stencil = false;
  EXPECT_EQ(name_of(masked.path()), "queued_less");
  EXPECT_FALSE(masked.in_tile().postpones_stencil);

  TestDraw blended;  // coverage, depth and the stencil test decide which values are updated
  blended.deferred = false;
  blended.state.stencil = StencilState{};
  blended.state.stencil->front.pass = StencilOp::replace;
  EXPECT_EQ(name_of(blended.path()), "queued_stencil");
  EXPECT_FALSE(blended.in_tile().postpones_stencil);
}

}  // namespace

}  // namespace halfspace
