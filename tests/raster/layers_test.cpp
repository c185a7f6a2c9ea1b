// SPDX-License-Identifier: Apache-2.0
//
// Tests order-independent transparency: compares the result with fragments sorted and blended in double precision.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "halfspace/raster/tile/layers.h"
#include "raster/raster_test.h"
#include "support/random.h"

namespace halfspace {

namespace {

using namespace raster_test;

constexpr int kSize = 96;

constexpr DrawState kLayered{.depth = {.write = false, .compare = CompareOp::less}, .order_independent = true};

struct Glass {
  std::vector<glm::vec4> corners;
  glm::vec4 color;
};

// Triangles that intersect each other, with depths between −0.9 and 0.9.
std::vector<Glass> random_glass(int count, uint32_t seed) {
  Random random(seed);
  std::vector<Glass> list;
  for (int i = 0; i < count; ++i) {
    Glass g;
    for (int k = 0; k < 3; ++k) g.corners.emplace_back(random.real(-1.2f, 1.2f), random.real(-1.2f, 1.2f), random.real(-0.9f, 0.9f), 1.0f);
    g.color = {random.real(0.0f, 1.0f), random.real(0.0f, 1.0f), random.real(0.0f, 1.0f), random.real(0.1f, 0.9f)};
    list.push_back(g);
  }
  return list;
}

struct Picture {
  Image<glm::vec4> color{kSize, kSize};
  PassStatistics statistics;
};

// Draws a gray background, an opaque triangle at depth 0 that covers part of it, and the glass in the given order.
Picture drawn(const std::vector<Glass>& glass, const std::vector<int>& order, int samples, int threads) {
  static const std::vector<glm::vec4> wall{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
  Picture out;
  ColorTarget target = rgba32f_target(out.color);
  target.clear_value = {0.5f, 0.5f, 0.5f, 1.0f};
  Pass pass(kSize, kSize, target, {.format = DepthFormat::d32f}, {.samples = samples});
  pass.draw(ConstantShader{glm::vec4(0.1f, 0.2f, 0.3f, 1.0f)}, make_vertex_view(stream(wall)));
  for (const int i : order) {
    const Glass& g = glass[static_cast<std::size_t>(i)];
    pass.draw(ConstantShader{g.color}, make_vertex_view(stream(g.corners)), kLayered);
  }
  out.statistics = pass.run(Workers(threads));
  return out;
}

std::vector<int> in_order(std::size_t count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

// Depth of the plane of a triangle at a pixel center, in double precision.
double plane_depth(const Glass& g, int x, int row) {
  const glm::dvec2 p((x + 0.5) / kSize * 2.0 - 1.0, 1.0 - (row + 0.5) / kSize * 2.0);
  const glm::dvec2 a(g.corners[0]), e1 = glm::dvec2(g.corners[1]) - a, e2 = glm::dvec2(g.corners[2]) - a, d = p - a;
  const double area = e1.x * e2.y - e1.y * e2.x, u = (d.x * e2.y - d.y * e2.x) / area, v = (e1.x * d.y - e1.y * d.x) / area;
  const auto z = [&](std::size_t i) { return static_cast<double>(g.corners[i].z); };
  return z(0) + u * (z(1) - z(0)) + v * (z(2) - z(0));
}

// Returns the pixels that a triangle covers, by drawing it alone in a pass. Coverage is exact.
Image<glm::vec4> coverage_of(const Glass& g) {
  Image<glm::vec4> image(kSize, kSize);
  Pass pass(kSize, kSize, rgba32f_target(image), {});
  pass.draw(ConstantShader{glm::vec4(1.0f)}, make_vertex_view(stream(g.corners)));
  pass.run(one_worker());
  return image;
}

struct Reference {
  glm::dvec3 color;
  int layers;
  double smallest_gap;  // smallest difference between two depths
};

Reference sorted_and_blended(const std::vector<Glass>& glass, const std::vector<Image<glm::vec4>>& coverage, int x, int row) {
  const bool wall = x <= row;  // pixel centers on the diagonal are covered; see the fill rule in conventions.md
  Reference out{wall ? glm::dvec3(0.1f, 0.2f, 0.3f) : glm::dvec3(0.5), 0, 1.0};
  std::vector<std::pair<double, std::size_t>> layers;
  for (std::size_t i = 0; i < glass.size(); ++i) {
    if (coverage[i].at(x, row).x == 0.0f) continue;
    const double z = plane_depth(glass[i], x, row);
    if (wall) out.smallest_gap = std::min(out.smallest_gap, std::fabs(z));
    if (!wall || z < 0.0) layers.emplace_back(z, i);
  }
  std::ranges::sort(layers, std::ranges::greater{});
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const glm::dvec4 c(glass[layers[k].second].color);
    out.color = out.color * (1.0 - c.w) + glm::dvec3(c) * c.w;
    if (k > 0) out.smallest_gap = std::min(out.smallest_gap, layers[k - 1].first - layers[k].first);
  }
  out.layers = static_cast<int>(layers.size());
  return out;
}

TEST(Layers, IntersectingTrianglesMatchASortInDoublePrecision) {
  int compared = 0, deepest = 0;
  for (uint32_t seed = 1; seed <= 6; ++seed) {
    const std::vector<Glass> glass = random_glass(22, seed);
    std::vector<Image<glm::vec4>> coverage;
    for (const Glass& g : glass) coverage.push_back(coverage_of(g));
    const Picture picture = drawn(glass, in_order(glass.size()), 1, 1);
    for (int row = 0; row < kSize; ++row) {
      for (int x = 0; x < kSize; ++x) {
        if (x == row) continue;  // the edge of the wall
        const Reference r = sorted_and_blended(glass, coverage, x, row);
        if (r.layers > TransparentLayers::kMaxLayers || r.smallest_gap < 1e-4) continue;  // vertices are snapped by up to 1/512 px
        const glm::vec4& c = picture.color.at(x, row);
        // Eight blends, each with three roundings of values up to 1.
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(static_cast<double>(c[k]), r.color[k], 24 * 0x1p-24) << seed << " " << x << " " << row;
        ++compared;
        deepest = std::max(deepest, r.layers);
      }
    }
  }
  EXPECT_GT(compared, 40000);
  EXPECT_EQ(deepest, TransparentLayers::kMaxLayers);
}

TEST(Layers, OrderThreadsAndDrawsDoNotMatter) {
  const std::vector<Glass> glass = random_glass(7, 99);
  for (const int samples : {1, 4}) {
    std::vector<int> order = in_order(glass.size());
    const Picture first = drawn(glass, order, samples, 1);
    EXPECT_EQ(first.statistics.layers_merged, 0u);
    std::ranges::reverse(order);
    const Picture reversed = drawn(glass, order, samples, 3);
    for (int i = 0; i < kSize * kSize; ++i)
      ASSERT_EQ(first.color.data()[i], reversed.color.data()[i]) << samples << " samples, pixel " << i;
  }
}

TEST(Layers, FurtherLayersMergeIntoTheFarthest) {
  // Twelve layers from the nearest to the farthest: the layers after the eighth arrive in the correct order, so the result is still exact.
  std::vector<Glass> glass;
  for (int i = 0; i < 12; ++i) {
    const float z = -0.9f + 0.05f * static_cast<float>(i);
    glass.push_back({{{-1, -1, z, 1}, {3, -1, z, 1}, {-1, 3, z, 1}}, {0.05f * static_cast<float>(i), 0.3f, 0.9f, 0.3f}});
  }
  const Picture picture = drawn(glass, in_order(glass.size()), 1, 1);
  EXPECT_EQ(picture.statistics.layers_merged, uint64_t{4} * kSize * kSize);
  glm::dvec3 expected(0.5);
  for (std::size_t i = 12; i-- > 0;) expected = expected * (1.0 - 0.3) + glm::dvec3(glass[i].color) * 0.3;
  const glm::vec4& c = picture.color.at(kSize - 1, 0);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(static_cast<double>(c[k]), expected[k], 1e-6);
}

TEST(Layers, EqualDepthsAreBlendedInTheOrderOfSubmission) {
  std::vector<Glass> glass(2, {{{-1, -1, -0.5f, 1}, {3, -1, -0.5f, 1}, {-1, 3, -0.5f, 1}}, {1, 0, 0, 0.5f}});
  glass[1].color = {0, 1, 0, 0.5f};
  const Picture picture = drawn(glass, {0, 1}, 1, 1);
  EXPECT_EQ(picture.color.at(kSize - 1, 0), glm::vec4(0.375f, 0.625f, 0.125f, 1.0f));
}

TEST(Layers, AreBlendedBeforeALaterDrawOfAnotherKind) {
  Image<glm::vec4> image(8, 8);
  ColorTarget target = rgba32f_target(image);
  const std::vector<glm::vec4> p = full_screen(0.0f), near = full_screen(-0.5f);
  Pass pass(8, 8, target, {.format = DepthFormat::d32f});
  pass.draw(ConstantShader{glm::vec4(1, 0, 0, 0.5f)}, make_vertex_view(stream(p)), kLayered);
  pass.draw(ConstantShader{glm::vec4(0, 0, 1, 1)}, make_vertex_view(stream(p)));  // opaque, drawn over the layers
  pass.draw(ConstantShader{glm::vec4(0, 1, 0, 0.25f)}, make_vertex_view(stream(near)), kLayered);
  pass.run(one_worker());
  EXPECT_EQ(image.at(3, 3), glm::vec4(0, 0.25f, 0.75f, 1));
}

TEST(Layers, ALaterDrawOfAnotherKindSeparatesLayersInAllTiles) {
  // The draw between the layers touches one pixel. The farther layer is drawn last, so it is blended over the nearer one everywhere.
  // Without the draw between them, or if it writes only depth, they are sorted.
  const std::vector<glm::vec4> near = full_screen(-0.5f), far = full_screen(0.5f);
  const std::vector<glm::vec4> small{{-1, -1, 0.9f, 1}, {-0.98f, -1, 0.9f, 1}, {-1, -0.96f, 0.9f, 1}};
  for (const int tile_size : {32, 64}) {
    for (const bool writes_color : {true, false}) {
      Image<glm::vec4> image(128, 64);
      Pass pass(128, 64, rgba32f_target(image), {.format = DepthFormat::d32f}, {.tuning = {.tile_size = tile_size}});
      pass.draw(ConstantShader{glm::vec4(1, 0, 0, 0.5f)}, make_vertex_view(stream(near)), kLayered);
      if (writes_color) {
        pass.draw(ConstantShader{glm::vec4(0, 0, 1, 1)}, make_vertex_view(stream(small)), kAlphaBlendState);
      } else {
        pass.draw_depth(ConstantShader{}, make_vertex_view(stream(small)));
      }
      pass.draw(ConstantShader{glm::vec4(0, 1, 0, 0.5f)}, make_vertex_view(stream(far)), kLayered);
      pass.run(one_worker());
      const glm::vec4 expected = writes_color ? glm::vec4(0.25f, 0.5f, 0, 0.75f) : glm::vec4(0.5f, 0.25f, 0, 0.75f);
      for (int x = 4; x < 128; ++x) ASSERT_EQ(image.at(x, 3), expected) << "pixel " << x << ", tiles of " << tile_size;
    }
  }
}

TEST(Layers, ColorsAreClampedForFixedPointFormats) {
  for (const bool layered : {true, false}) {
    Image<glm::u8vec4> image(8, 8);
    const std::vector<glm::vec4> p = full_screen();
    Pass pass(8, 8, rgba8_target(image), {.format = DepthFormat::d32f});
    pass.draw(ConstantShader{glm::vec4(4, -1, 0.5f, 0.25f)}, make_vertex_view(stream(p)), layered ? kLayered : kAlphaBlendState);
    pass.run(one_worker());
    EXPECT_EQ(glm::u8vec3(image.at(3, 3)), glm::u8vec3(64, 0, 32)) << layered;  // 1/4, 0 and 1/8
  }
}

TEST(Layers, OtherPixelsKeepTheirBits) {
  Image<glm::vec4> image(8, 8);
  std::fill_n(image.data(), 64, glm::vec4(-0.0f));
  const std::vector<glm::vec4> p{{-1, -1, 0, 1}, {-0.7f, -1, 0, 1}, {-1, -0.7f, 0, 1}};  // covers the pixel at the lower left
  ColorTarget target = rgba32f_target(image);
  target.load = LoadOp::load;
  Pass pass(8, 8, target, {.format = DepthFormat::d32f});
  pass.draw(ConstantShader{glm::vec4(1, 1, 1, 0.5f)}, make_vertex_view(stream(p)), kLayered);
  EXPECT_EQ(pass.run(one_worker()).samples_passed, 1u);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) EXPECT_EQ(std::signbit(pixel(image, x, y).x), x != 0 || y != 0) << x << ' ' << y;
  }
}

}  // namespace

}  // namespace halfspace
