// SPDX-License-Identifier: Apache-2.0
//
// Clusters that are hidden by the depth of an earlier pass: the picture is the same with and without culling, bit for bit.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "halfspace/raster/depth_pyramid.h"
#include "raster/placed_mesh.h"

namespace halfspace::raster_test {
namespace {

struct HiddenPicture {
  Image<glm::vec4> color{160, 120};
  Image<float> depth{160, 120};
};

struct PlacedMesh {
  const Mesh& mesh;
  const Clusters& clusters;
  Placement place;
};

// Draws a mesh in a pass of its own, which loads the picture.
PassStatistics draw_over(HiddenPicture& picture, const PlacedMesh& m, DrawState state, const DepthPyramid* pyramid, int samples = 1) {
  ColorTarget color = rgba32f_target(picture.color);
  DepthTarget depth = d32f_target(picture.depth);
  color.load = depth.load = LoadOp::load;
  Pass pass(160, 120, color, depth, {.samples = samples});
  if (pyramid != nullptr) state.clusters = ClusterCulling{&m.clusters, m.place.clip_from_world, m.place.world_from_object, pyramid};
  const Indices indices(m.mesh.indices, m.mesh.positions.size());
  pass.draw(PlacedShader{m.place}, make_vertex_view(stream(m.mesh.positions)), indices, state);
  return pass.run(one_worker());
}

DepthPyramid pyramid_of(HiddenPicture& picture) { return DepthPyramid(d32f_target(picture.depth), one_worker()); }

// Draws a mesh with and without the pyramid of what is in the picture, compares the pictures, and returns the share of skipped triangles.
double expect_same_over(const HiddenPicture& before, const PlacedMesh& m, const DrawState& state, int samples = 1) {
  HiddenPicture whole = before, left = before;
  const DepthPyramid pyramid = pyramid_of(left);
  draw_over(whole, m, state, nullptr, samples);
  const PassStatistics s = draw_over(left, m, state, &pyramid, samples);
  EXPECT_TRUE(std::memcmp(whole.color.data(), left.color.data(), whole.color.texels().size_bytes()) == 0);
  EXPECT_TRUE(std::memcmp(whole.depth.data(), left.depth.data(), whole.depth.texels().size_bytes()) == 0);
  return static_cast<double>(s.culled_cluster) / static_cast<double>(m.mesh.indices.size() / 3);
}

Clusters clusters_of(const Mesh& mesh) { return Clusters(stream(mesh.positions), Indices(mesh.indices, mesh.positions.size())); }

HiddenPicture filled(float depth) {
  HiddenPicture picture;
  std::fill_n(picture.depth.data(), picture.depth.texels().size(), depth);
  return picture;
}

TEST(DepthPyramid, BoundsAreThoseOfThePixels) {
  Random r(1);
  for (const auto& [width, height] : {std::pair{1, 1}, {8, 8}, {61, 37}, {300, 5}, {5, 300}}) {
    Image<float> depth(width, height);
    const float slope = 0.002f;  // the last blocks of a row and of a column have the largest depths
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) depth.at(x, y) = r.real(0.0f, 0.1f) + slope * static_cast<float>(x + y);
    }
    const DepthPyramid pyramid(depth_target(texel_view(depth, TexelFormat::d32f)), two_workers());
    const auto exact = [&](int x0, int y0, int x1, int y1) {
      DepthPyramid::Bounds out{1.0f, 0.0f};
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) out = {std::min(out.low, depth.at(x, y)), std::max(out.high, depth.at(x, y))};
      }
      return out;
    };
    const DepthPyramid::Bounds all = pyramid.bounds(0, 0, width, height), expected = exact(0, 0, width, height);
    EXPECT_EQ(all.low, expected.low);
    EXPECT_EQ(all.high, expected.high);
    for (int i = 0; i < 200; ++i) {
      const int x0 = r.below(width), y0 = r.below(height), x1 = x0 + 1 + r.below(width - x0), y1 = y0 + 1 + r.below(height - y0);
      const DepthPyramid::Bounds b = pyramid.bounds(x0, y0, x1, y1), inside = exact(x0, y0, x1, y1);
      EXPECT_LE(b.low, inside.low);
      EXPECT_GE(b.high, inside.high);
      if (x1 - x0 > 32 || y1 - y0 > 32) continue;
      // Five blocks of 8 pixels contain 33 pixels, wherever they begin.
      const DepthPyramid::Bounds blocks =
          exact(x0 / 8 * 8, y0 / 8 * 8, std::min(width, (x1 + 7) / 8 * 8), std::min(height, (y1 + 7) / 8 * 8));
      EXPECT_EQ(b.low, blocks.low);
      EXPECT_EQ(b.high, blocks.high);
    }
  }
}

// A unit sphere at a distance of 10 fills the depths of 9 to 11. A cluster is a strip of 32 of its 400 columns, which turns by 29°. Of a
// ring of clusters, (180° − 29°) / 360° lie completely in one half.
TEST(DepthPyramid, WhatIsBehindIsSkipped) {
  constexpr double kHalf = (180.0 - 29.0) / 360.0, kEnds = 0.05;  // some clusters turn corners from one ring to the next
  const Mesh mesh = uv_sphere(100, 400, 1.0f);
  const Clusters clusters = clusters_of(mesh);
  const glm::dmat4 projection = perspective();
  const PlacedMesh m{mesh, clusters, glm::mat4(projection * glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -10.0)))};
  const auto depth_at = [&](double distance) {
    const glm::dvec4 p = projection * glm::dvec4(0.0, 0.0, -distance, 1.0);
    return static_cast<float>(0.5 * p.z / p.w + 0.5);
  };
  EXPECT_EQ(expect_same_over(filled(depth_at(8.9)), m, {}), 1.0);
  EXPECT_EQ(expect_same_over(filled(depth_at(11.1)), m, {}), 0.0);
  EXPECT_NEAR(expect_same_over(filled(depth_at(10.0)), m, {}), kHalf, kEnds);
  // What is drawn at the left hides half of the sphere.
  HiddenPicture half = filled(1.0f);
  for (int y = 0; y < 120; ++y) std::fill_n(half.depth.row(y).begin(), 80, depth_at(8.9));
  EXPECT_NEAR(expect_same_over(half, m, {}), kHalf, kEnds);
  // What is equally far passes with less_equal.
  HiddenPicture again = filled(1.0f);
  draw_over(again, m, {}, nullptr);
  expect_same_over(again, m, {.depth = {.compare = CompareOp::less_equal}});
}

TEST(DepthPyramid, HasNoEffectWhereHiddenTrianglesMatter) {
  const Mesh mesh = uv_sphere(20, 30, 1.0f);
  const Clusters clusters = clusters_of(mesh);
  const PlacedMesh m{mesh, clusters, glm::mat4(perspective() * glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -10.0)))};
  const HiddenPicture near = filled(0.1f);
  EXPECT_EQ(expect_same_over(near, m, {}), 1.0);
  EXPECT_EQ(expect_same_over(near, m, {.depth = {.compare = CompareOp::not_equal}}), 0.0);
  EXPECT_EQ(expect_same_over(near, m, {.depth = {.test = false}}), 0.0);
  EXPECT_EQ(expect_same_over(near, m, {.depth = {.clamp = true}}), 0.0);
  EXPECT_EQ(expect_same_over(near, m, {.offset = {.constant = -1.0f}}), 0.0);
  EXPECT_EQ(expect_same_over(near, m, {.polygon_mode = PolygonMode::line}), 0.0);
}

// Occluders and meshes of all sizes, with eyes inside of them; both directions of depth, ranges in reverse, and shaders with two matrices
// whose rounding errors are larger than pixels.
TEST(DepthPyramid, RandomViewsHaveTheSamePicture) {
  const std::vector<Mesh> meshes{uv_sphere(60, 90, 1.0f), torus_knot(0.7f, 0.25f, 60, 200)};
  std::vector<Clusters> clusters;
  for (const Mesh& mesh : meshes) clusters.push_back(clusters_of(mesh));
  Random r(5);
  const auto choose = [&](int n) { return static_cast<std::size_t>(r.below(n)); };
  const auto real = [&](double low, double high) { return low + (high - low) * static_cast<double>(r.real(0.0f, 1.0f)); };
  double skipped = 0.0;
  constexpr int kScenes = 150;
  for (int i = 0; i < kScenes; ++i) {
    const bool is_reversed = r.below(3) == 0, is_orthographic = r.below(4) == 0;
    const double near = 0.05 * std::exp(real(-1.0, 1.0));
    glm::dmat4 projection = perspective(near, 20.0);
    if (is_reversed) projection = perspective_reversed(real(0.3, 1.5), 4.0 / 3.0, near, 20.0);
    if (is_orthographic && !is_reversed) projection = orthographic_gl(2.0, 4.0 / 3.0, -2.0, 20.0);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(real(-1, 1), real(-1, 1), real(-1, 1)));
    const glm::dmat4 view = look_at(direction * std::exp(real(-0.5, 2.0)), glm::dvec3(real(-0.3, 0.3)), {0.1, 1.0, 0.2});
    DrawState state;
    if (is_reversed) state.depth = {.compare = CompareOp::greater, .clip = ClipDepth::zero_to_one};
    if (r.below(2) == 0) state.depth.compare = is_reversed ? CompareOp::greater_equal : CompareOp::less_equal;
    if (r.below(4) == 0) {
      state.depth.range_near = 0.2f;
      state.depth.range_far = 0.7f;
      if (r.below(3) == 0) std::swap(state.depth.range_near, state.depth.range_far);
    }
    if (r.below(4) == 0) state.viewport = ViewportRect(10.5f, 100.0f, 120.25f, -80.0f);
    if (r.below(4) == 0) state.scissor = Rect{20, 30, 70, 50};
    HiddenPicture picture = filled(is_reversed ? 0.0f : 1.0f);
    for (int k = 0; k < 3; ++k) {  // occluders
      const std::size_t n = choose(2);
      const glm::dmat4 place =
          glm::scale(glm::translate(glm::dmat4(1.0), direction * real(0.0, 1.5)), glm::dvec3(std::exp(real(-2.0, 0.0))));
      draw_over(picture, {meshes[n], clusters[n], glm::mat4(projection * view * place)}, state, nullptr);
    }
    glm::dmat4 world(1.0);
    if (r.below(3) == 0) {
      const double far = std::exp(real(0.0, 10.0));
      world = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(far, -0.5 * far, 0.3 * far)), real(0.0, 6.0), {0.1, 1.0, 0.3});
    }
    const std::size_t n = choose(2);
    SCOPED_TRACE(i);
    const PlacedMesh m{meshes[n], clusters[n], {glm::mat4(projection * view * glm::inverse(world)), glm::mat4(world)}};
    skipped += expect_same_over(picture, m, state, r.below(4) == 0 ? 4 : 1);
  }
  EXPECT_GT(skipped / kScenes, 0.1);  // otherwise, little would be hidden
}

TEST(DepthPyramidDeathTest, ChecksTheDepthAndThePass) {
  const Mesh mesh = uv_sphere(8, 12, 1.0f);
  const Clusters clusters = clusters_of(mesh);
  const Indices indices(mesh.indices, mesh.positions.size());
  const VertexView vertices = make_vertex_view(stream(mesh.positions));
  Image<float> depth(16, 16), other(16, 16);
  Image<uint16_t> codes(16, 16);
  EXPECT_DEATH(DepthPyramid(d16_target(codes), one_worker()), "expected d32f");
  EXPECT_DEATH(DepthPyramid(DepthTarget{.format = DepthFormat::d32f}, one_worker()), "has no pixels");
  DepthTarget samples = d32f_target(depth);
  samples.samples = 4;
  EXPECT_DEATH(DepthPyramid(samples, one_worker()), "several samples");
  // Draws with the pyramid of `from`, after `first` if there is one.
  const auto draw = [&](Image<float>& from, LoadOp load, std::optional<DrawState> first, const DepthState& state = {}) {
    const DepthPyramid pyramid(d32f_target(from), one_worker());
    DepthTarget target = d32f_target(depth);
    target.load = load;
    Pass pass(16, 16, ColorTarget{}, target);
    if (first) pass.draw(PlacedShader{glm::mat4(1.0f)}, vertices, indices, *first);
    const ClusterCulling culling{&clusters, glm::mat4(1.0f), glm::mat4(1.0f), &pyramid};
    pass.draw(PlacedShader{glm::mat4(1.0f)}, vertices, indices, {.depth = state, .clusters = culling});
  };
  EXPECT_DEATH(draw(other, LoadOp::load, {}), "the same target");
  EXPECT_DEATH(draw(depth, LoadOp::clear, {}), "expected LoadOp::load");
  const DrawState farther{.depth = {.compare = CompareOp::greater}}, anything{.depth = {.compare = CompareOp::always}};
  EXPECT_DEATH(draw(depth, LoadOp::load, farther), "the same direction");
  EXPECT_DEATH(draw(depth, LoadOp::load, anything), "the same direction");
  EXPECT_DEATH(draw(depth, LoadOp::load, DrawState{}, {.compare = CompareOp::greater}), "the same direction");
  draw(depth, LoadOp::load, DrawState{});
  draw(depth, LoadOp::load, DrawState{.depth = {.write = false, .compare = CompareOp::always}});
}

}  // namespace
}  // namespace halfspace::raster_test
