// SPDX-License-Identifier: Apache-2.0
//
// Draws triangles that cover whole tiles, and others, in random order. Full-tile writes are delayed, which must not be visible. Tiles of 32
// px never delay writes (raster/visibility/full_tile.h requires 64 px), so both tile sizes must give the same result. Other tests verify
// the result itself.
#include "halfspace/raster/visibility/full_tile.h"

#include <algorithm>
#include <deque>
#include <set>

#include "halfspace/shading/surface/depth_only.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

constexpr int kStepsWidth = 128, kStepsHeight = 64;

struct Step {
  std::vector<glm::vec4> positions;  // clip space
  glm::vec4 color;
  DrawState state;
  bool depth_only;
};

// Returns one of three kinds of triangles: one that covers the whole picture, with one depth or two; a small one at a random position; or
// one that covers about half of the picture.
std::vector<glm::vec4> random_positions(Random& r) {
  const auto depth = [&] { return 0.125f * static_cast<float>(r.integer(-7, 7)); };
  const float z = depth(), far_z = r.coin() ? z : depth();
  if (r.integer(0, 2) != 0) return {{-4, -4, z, 1}, {8, -4, z, 1}, {-4, 8, far_z, 1}};
  const float x = r.real(-1.0f, 1.0f), y = r.real(-1.0f, 1.0f), size = r.coin() ? 0.2f : 2.0f;
  return {{x, y, z, 1}, {x + size, y, z, 1}, {x, y + size, far_z, 1}};
}

Step random_step(Random& r) {
  Step s{random_positions(r), glm::vec4(r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), 0.5f), {}, r.integer(0, 5) == 0};
  s.state.depth.test = r.integer(0, 5) != 0;
  s.state.depth.write = r.integer(0, 4) != 0;
  s.state.depth.compare = r.integer(0, 1) == 0 ? CompareOp::less : static_cast<CompareOp>(r.integer(0, 7));
  if (r.integer(0, 5) == 0)
    s.state.blend = BlendState{.source_color = BlendFactor::src_alpha, .destination_color = BlendFactor::one_minus_src_alpha};
  if (r.integer(0, 7) == 0) s.state.color_mask.g = false;
  s.state.query = static_cast<uint32_t>(r.integer(0, 2));
  return s;
}

struct StepsPicture {
  Image<glm::vec4> color{kStepsWidth, kStepsHeight};
  Image<float> depth{kStepsWidth, kStepsHeight};
  PassStatistics statistics;
};

StepsPicture drawn(const std::vector<Step>& steps, int tile_size, bool has_depth) {
  StepsPicture out;
  Pass pass(kStepsWidth, kStepsHeight, rgba32f_target(out.color), has_depth ? d32f_target(out.depth) : DepthTarget{},
            {.tuning = {.tile_size = tile_size}});
  const Indices triangle = Indices::sequential(3);
  std::deque<std::vector<glm::vec3>> origins;
  std::deque<std::vector<glm::vec4>> colors;
  for (const Step& s : steps) {
    if (s.depth_only) {
      const auto& at = origins.emplace_back(s.positions.begin(), s.positions.end());
      pass.draw_depth(DepthOnly{glm::mat4(1.0f)}, make_vertex_view(stream(at)), triangle, s.state);
    } else {
      const auto& color = colors.emplace_back(3, s.color);
      pass.draw(FlatColorShader{}, make_vertex_view(stream(s.positions), stream(color)), triangle, s.state);
    }
  }
  out.statistics = pass.run(one_worker());
  return out;
}

TEST(FullTileOccluder, MatchesSmallerTiles) {
  int pictures = 0;
  std::set<std::vector<uint64_t>> counts;
  for (int seed = 0; seed < effort(4000); ++seed) {
    Random r(static_cast<uint64_t>(seed));
    std::vector<Step> steps;
    for (int n = r.integer(1, 8); n > 0; --n) steps.push_back(random_step(r));
    const bool has_depth = r.integer(0, 3) != 0;
    const StepsPicture whole = drawn(steps, 64, has_depth), parts = drawn(steps, 32, has_depth);
    ASSERT_TRUE(std::ranges::equal(whole.color.texels(), parts.color.texels())) << seed;
    ASSERT_TRUE(std::ranges::equal(whole.depth.texels(), parts.depth.texels())) << seed;
    ASSERT_EQ(whole.statistics.queries, parts.statistics.queries) << seed;
    ASSERT_EQ(whole.statistics.samples_passed, parts.statistics.samples_passed) << seed;
    counts.insert(whole.statistics.queries);
    ++pictures;
  }
  EXPECT_GT(counts.size(), static_cast<std::size_t>(pictures) / 4) << "the random pictures are too similar";
}

// Gives every pixel the same depth.
struct DeepShader : FlatColorShader {
  float depth;
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color.value, true, R(depth)};
  }
};

// Depths written by a shader may be outside the depth bounds of the tile.
TEST(FullTileOccluder, IsTestedAgainstDepthsWrittenByAShader) {
  for (const float written : {0.125f, 0.875f}) {
    for (const CompareOp op : {CompareOp::less, CompareOp::greater}) {
      Image<glm::vec4> color(kStepsWidth, kStepsHeight);
      Image<float> depth(kStepsWidth, kStepsHeight);
      DepthTarget target = d32f_target(depth);
      target.clear_value = 0.5f;
      Pass pass(kStepsWidth, kStepsHeight, rgba32f_target(color), target);
      const float z = 0.5f * (written + 0.5f);  // between the written depth and the previous one
      const auto place = [](float window_z) {
        const float z_ndc = 2.0f * window_z - 1.0f;
        return std::vector<glm::vec4>{{-4, -4, z_ndc, 1}, {8, -4, z_ndc, 1}, {-4, 8, z_ndc, 1}};
      };
      const std::vector<glm::vec4> middle = place(0.5f), next = place(z), red(3, {1, 0, 0, 1}), green(3, {0, 1, 0, 1});
      const Indices triangle = Indices::sequential(3);
      DrawState state;
      state.depth.compare = CompareOp::always;
      pass.draw(DeepShader{{}, written}, make_vertex_view(stream(middle), stream(red)), triangle, state);
      state.depth.compare = op;
      pass.draw(FlatColorShader{}, make_vertex_view(stream(next), stream(green)), triangle, state);
      pass.run(one_worker());
      const bool passes = op == CompareOp::less ? z < written : z > written;
      for (const glm::vec4& c : color.texels()) ASSERT_EQ(c, passes ? green[0] : red[0]) << written << " " << static_cast<int>(op);
    }
  }
}

// Occluded triangles cost only a depth test, and triangles that are hidden later are never shaded.
TEST(FullTileOccluder, ShadesOnlyVisibleFragments) {
  std::vector<Step> steps;
  for (const float z : {0.5f, 0.25f, 0.75f, -0.5f, 0.0f})
    steps.push_back({{{-4, -4, z, 1}, {8, -4, z, 1}, {-4, 8, z, 1}}, glm::vec4(z), {}, false});
  const StepsPicture d = drawn(steps, 64, true);
  EXPECT_EQ(d.statistics.fragments_shaded, uint64_t{kStepsWidth} * kStepsHeight);
  EXPECT_EQ(d.statistics.samples_tested, 3 * uint64_t{kStepsWidth} * kStepsHeight);
  EXPECT_EQ(d.color.at(100, 10), glm::vec4(-0.5f));
  EXPECT_EQ(d.depth.at(100, 10), 0.25f);
}

// The colors of a tile are not loaded if its only triangle replaces all of them. Elsewhere, the previous colors or the clear value remain,
// and never those of the tile that was in the same memory before.
TEST(FullTile, KeepsTheColorsAroundTheOnlyTriangle) {
  const glm::vec4 stale(1, 1, 1, 1), stored(0, 0, 1, 1), cleared(1, 0, 0, 1), green(0, 1, 0, 1);
  const Indices triangle = Indices::sequential(3);
  for (const LoadOp load : {LoadOp::clear, LoadOp::load}) {
    for (const float edge : {-0.9f, -0.1f, 0.55f, 2.5f}) {  // x + y on the long edge, in NDC; no pixel center is on it
      drawn({{{{-4, -4, 0, 1}, {8, -4, 0, 1}, {-4, 8, 0, 1}}, stale, {}, false}}, 64, false);
      Image<glm::vec4> color(kStepsWidth, kStepsHeight);
      for (int y = 0; y < kStepsHeight; ++y) std::ranges::fill(color.row(y), stored);
      ColorTarget target = rgba32f_target(color);
      target.load = load;
      target.clear_value = cleared;
      const std::vector<glm::vec4> positions{{-4, -4, 0, 1}, {edge + 4, -4, 0, 1}, {-4, edge + 4, 0, 1}}, colors(3, green);
      Pass pass(kStepsWidth, kStepsHeight, target, {});
      pass.draw(FlatColorShader{}, make_vertex_view(stream(positions), stream(colors)), triangle, {});
      pass.run(one_worker());
      for (int y = 0; y < kStepsHeight; ++y) {
        for (int x = 0; x < kStepsWidth; ++x) {
          const float x_ndc = (2.0f * static_cast<float>(x) + 1.0f) / kStepsWidth - 1.0f;
          const float y_ndc = 1.0f - (2.0f * static_cast<float>(y) + 1.0f) / kStepsHeight;
          ASSERT_EQ(color.at(x, y), x_ndc + y_ndc < edge   ? green
                                    : load == LoadOp::load ? stored
                                                           : cleared)
              << x << " " << y << ", edge " << edge;
        }
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::raster_test
