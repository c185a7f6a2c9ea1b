// SPDX-License-Identifier: Apache-2.0
//
// Depth images whose tiles are drawn when they are needed have the bits of a whole pass, and only in those tiles.
#include "halfspace/raster/depth_on_demand.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "raster/raster_test.h"
#include "support/throwing_checks.h"

namespace halfspace::raster_test {
namespace {

constexpr float kUntouched = -7.0f;

struct DemandCase {
  int width, height, tile_size;
};
constexpr std::array kCases{DemandCase{256, 128, 64}, DemandCase{200, 150, 64}, DemandCase{61, 37, 8}, DemandCase{5, 90, 16}};

// Triangles of all sizes, some of which are clipped.
std::vector<glm::vec4> random_triangles(uint64_t seed, int count = 60) {
  Random r(seed);
  std::vector<glm::vec4> corners;
  for (int i = 0; i < count; ++i) {
    const auto size = static_cast<float>(r.magnitude(0.02, 2.0));
    const glm::vec2 center(r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f));
    for (int k = 0; k < 3; ++k)
      corners.emplace_back(center.x + r.real(-size, size), center.y + r.real(-size, size), r.real(-1.1f, 1.1f), r.real(0.9f, 1.5f));
  }
  return corners;
}

Image<float> filled(const DemandCase& c, float depth) {
  Image<float> image(c.width, c.height);
  std::fill_n(image.data(), image.texels().size(), depth);
  return image;
}
Image<float> untouched(const DemandCase& c) { return filled(c, kUntouched); }

Pass depth_pass(const DemandCase& c, Image<float>& image, const std::vector<glm::vec4>& corners, const PassTuning& tuning = {}) {
  PassOptions options{.tuning = tuning};
  options.tuning.tile_size = c.tile_size;
  Pass pass(c.width, c.height, ColorTarget{}, d32f_target(image), options);
  pass.draw_depth(PositionShader{}, make_vertex_view(stream(corners)));
  return pass;
}

// Checks that the tiles for which is_drawn(tile_x, tile_y) is true are those of the whole image, and that the others are untouched.
template <class F>
void expect_tiles(const DemandCase& c, const Image<float>& image, const Image<float>& whole, const F& is_drawn) {
  int wrong = 0;
  for (int y = 0; y < c.height; ++y) {
    for (int x = 0; x < c.width; ++x)
      wrong += pixel(image, x, y) != (is_drawn(x / c.tile_size, y / c.tile_size) ? pixel(whole, x, y) : kUntouched);
  }
  EXPECT_EQ(wrong, 0) << c.width << " x " << c.height << ", tiles of " << c.tile_size;
}

TEST(DepthOnDemand, OnlyRequiredTilesAreDrawnAndTheyAreThoseOfAWholePass) {
  for (const DemandCase& c : kCases) {
    const std::vector<glm::vec4> corners = random_triangles(static_cast<uint64_t>(c.width));
    Image<float> whole = untouched(c);
    const PassStatistics all = depth_pass(c, whole, corners).run(one_worker());
    Random r(1);
    for (int i = 0; i < 20; ++i) {
      Image<float> image = untouched(c);
      const DepthOnDemand demand(depth_pass(c, image, corners), one_worker());
      expect_tiles(c, image, whole, [](int, int) { return false; });
      const int x0 = r.below(c.width), x1 = r.between(x0, c.width - 1), y0 = r.below(c.height), y1 = r.between(y0, c.height - 1);
      demand.tiles().require(x0, y0, x1, y1);
      const int s = c.tile_size;
      expect_tiles(c, image, whole, [&](int x, int y) { return x >= x0 / s && x <= x1 / s && y >= y0 / s && y <= y1 / s; });
      EXPECT_LE(demand.statistics().samples_passed, all.samples_passed);
      demand.draw_all(one_worker());
      expect_tiles(c, image, whole, [](int, int) { return true; });
      EXPECT_EQ(demand.statistics(), all);
    }
  }
}

TEST(DepthOnDemand, EachLaneRequiresItsOwnTiles) {
  const DemandCase c = kCases[2];
  const std::vector<glm::vec4> corners = random_triangles(2);
  Image<float> whole = untouched(c);
  depth_pass(c, whole, corners).run(one_worker());
  Random r(3);
  for (int i = 0; i < 200; ++i) {
    Image<float> image = untouched(c);
    const DepthOnDemand demand(depth_pass(c, image, corners), one_worker());
    std::vector<uint8_t> needed(64, 0);  // 8 x 5 tiles, with rows of 8
    Int x0, y0, x1, y1;
    for (int k = 0; k < kLanes; ++k) {
      const int x = r.below(c.width), y = r.below(c.height), right = std::min(x + r.below(12), c.width - 1),
                high = std::min(y + r.below(12), c.height - 1);
      set_lane(x0, k, x);
      set_lane(y0, k, y);
      set_lane(x1, k, right);
      set_lane(y1, k, high);
      for (int ty = y / 8; ty <= high / 8; ++ty) {
        for (int tx = x / 8; tx <= right / 8; ++tx) needed[static_cast<std::size_t>(ty * 8 + tx)] = 1;
      }
    }
    demand.tiles().require(x0, y0, x1, y1);
    expect_tiles(c, image, whole, [&](int x, int y) { return needed[static_cast<std::size_t>(y * 8 + x)] != 0; });
  }
}

TEST(DepthOnDemand, CoordinatesOutsideOfTheImageAreClamped) {
  constexpr int kLowest = std::numeric_limits<int>::min(), kHighest = std::numeric_limits<int>::max();
  const DemandCase c = kCases[1];  // 4 x 3 tiles
  const std::vector<glm::vec4> corners = random_triangles(4);
  Image<float> whole = untouched(c), image = untouched(c);
  depth_pass(c, whole, corners).run(one_worker());
  const DepthOnDemand demand(depth_pass(c, image, corners), one_worker());
  demand.tiles().require(kLowest, kLowest, -1, -1);
  expect_tiles(c, image, whole, [](int x, int y) { return x == 0 && y == 0; });
  demand.tiles().require(c.width, 10, kHighest, 20);
  expect_tiles(c, image, whole, [](int x, int y) { return (x == 0 || x == 3) && y == 0; });
  demand.tiles().require(kLowest, kLowest, kHighest, kHighest);
  expect_tiles(c, image, whole, [](int, int) { return true; });
}

TEST(DepthOnDemand, EachTileIsDrawnOnceByAnyNumberOfThreads) {
  const DemandCase c = kCases[2];
  const std::vector<glm::vec4> corners = random_triangles(5, 400);
  Image<float> whole = untouched(c);
  const PassStatistics all = depth_pass(c, whole, corners).run(one_worker());
  const Workers workers(4);
  for (int i = 0; i < effort(100); ++i) {
    Image<float> image = untouched(c);
    const DepthOnDemand demand(depth_pass(c, image, corners), workers);
    std::atomic<int> wrong = 0;
    workers.for_each(16, [&](int task) {
      for (int k = 0; k < 61; ++k) {
        const int x = (k * 7 + task) % c.width, y = k % c.height;
        demand.tiles().require(x, y, x, y);
        if (pixel(image, x, y) != pixel(whole, x, y)) ++wrong;
      }
    });
    EXPECT_EQ(wrong, 0);
    demand.draw_all(workers);
    EXPECT_EQ(demand.statistics(), all);
  }
}

TEST(DepthOnDemand, AllTilesAreDrawnAtOnceIfTheTrianglesExceedTheBudget) {
  const DemandCase c = kCases[1];
  const std::vector<glm::vec4> corners = random_triangles(6, 2000);
  const PassTuning small{.chunk_triangles = 10, .bin_budget = 1000};
  Image<float> whole = untouched(c), image = untouched(c);
  const PassStatistics all = depth_pass(c, whole, corners, small).run(one_worker());
  EXPECT_GT(all.flushes, 0u);
  const DepthOnDemand demand(depth_pass(c, image, corners, small), one_worker());
  expect_tiles(c, image, whole, [](int, int) { return true; });
  demand.draw_all(one_worker());
  EXPECT_EQ(demand.statistics(), all);
}

TEST(DepthOnDemand, APassThatLoadsItsDepthKeepsIt) {
  const DemandCase c = kCases[0];
  const std::vector<glm::vec4> corners = random_triangles(7, 5);
  Image<float> whole = filled(c, 0.4f), image = filled(c, 0.4f);
  const auto pass = [&](Image<float>& to) {
    DepthTarget target = d32f_target(to);
    target.load = LoadOp::load;
    Pass p(c.width, c.height, ColorTarget{}, target);
    p.draw_depth(PositionShader{}, make_vertex_view(stream(corners)));
    return p;
  };
  pass(whole).run(one_worker());
  const DepthOnDemand demand(pass(image), one_worker());
  demand.draw_all(one_worker());
  EXPECT_EQ(std::memcmp(image.data(), whole.data(), whole.texels().size_bytes()), 0);
  EXPECT_EQ(pixel(image, 0, 0), pixel(whole, 0, 0));
}

// Throws in the first call of its visibility function.
struct FailsOnce : PositionShader {
  std::atomic<int>* calls;
  template <class R>
  Visibility<R> visibility(const NoVaryings<R>&, const Pixel<R>& px) const {
    if (calls->fetch_add(1) == 0) throw std::runtime_error("failed");
    return {px.z() >= R(0.0f), px.z()};
  }
};

TEST(DepthOnDemand, ATileWhoseShaderThrewIsDrawnWhenItIsRequiredAgain) {
  const DemandCase c{64, 64, 64};
  const std::vector<glm::vec4> corners = full_screen(0.5f);
  Image<float> image = untouched(c);
  std::atomic<int> calls = 0;
  FailsOnce shader;
  shader.calls = &calls;
  Pass pass(c.width, c.height, ColorTarget{}, d32f_target(image));
  pass.draw_depth(shader, make_vertex_view(stream(corners)));
  const DepthOnDemand demand(std::move(pass), one_worker());
  EXPECT_THROW(demand.tiles().require(0, 0, 0, 0), std::runtime_error);
  demand.tiles().require(0, 0, 0, 0);
  EXPECT_EQ(pixel(image, 3, 3), 0.75f);  // z = 0.5 in the default depth range
}

TEST(DepthOnDemand, AThreadThatWaitsDrawsTheTileIfTheOtherOneFails) {
  const DemandCase c{64, 64, 64};
  const std::vector<glm::vec4> corners = full_screen(0.5f);
  const Workers workers(4);
  for (int i = 0; i < effort(100); ++i) {
    Image<float> image = untouched(c);
    std::atomic<int> calls = 0, thrown = 0;
    FailsOnce shader;
    shader.calls = &calls;
    Pass pass(c.width, c.height, ColorTarget{}, d32f_target(image));
    pass.draw_depth(shader, make_vertex_view(stream(corners)));
    const DepthOnDemand demand(std::move(pass), one_worker());
    workers.for_each(4, [&](int) {
      try {
        demand.tiles().require(0, 0, 0, 0);
      } catch (const std::runtime_error&) {
        ++thrown;
        demand.tiles().require(0, 0, 0, 0);
      }
    });
    EXPECT_EQ(thrown, 1);
    EXPECT_EQ(pixel(image, 3, 3), 0.75f);  // z = 0.5 in the default depth range
    EXPECT_EQ(demand.statistics().samples_passed, 64u * 64u);
  }
}

TEST(DepthOnDemand, AllFormatsLoadAndClearAsInAWholePass) {
  constexpr int kWidth = 100, kHeight = 70;
  const std::vector<glm::vec4> corners = random_triangles(9, 30);
  const StencilFace count{.pass = StencilOp::increment_wrap};
  for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f, DepthFormat::d24s8, DepthFormat::d32fs8}) {
    for (const LoadOp load : {LoadOp::clear, LoadOp::load}) {
      for (const LoadOp stencil_load : {LoadOp::clear, LoadOp::load}) {
        const std::size_t texel = texel_info(format).bytes, pitch = (kWidth + 3) * texel;
        const std::vector<std::byte> before(pitch * kHeight, std::byte{0x2a});
        const auto pass_into = [&](std::vector<std::byte>& bytes) {
          DepthTarget target = depth_target(TexelView{
              .format = format, .data = bytes.data(), .width = kWidth, .height = kHeight, .row_pitch = static_cast<std::ptrdiff_t>(pitch)});
          target.load = load;
          if (has_stencil(format)) target.stencil_load = stencil_load;
          Pass pass(kWidth, kHeight, ColorTarget{}, target);
          DrawState state;
          if (has_stencil(format)) state.stencil = StencilState{count, count};
          pass.draw_depth(PositionShader{}, make_vertex_view(stream(corners)), state);
          pass.clear({.rect = Rect{20, 10, 50, 40}, .depth = 0.25f});
          pass.draw_depth(PositionShader{}, make_vertex_view(stream(corners)), state);
          return pass;
        };
        std::vector<std::byte> whole = before, tiles = before;
        const PassStatistics all = pass_into(whole).run(one_worker());
        const DepthOnDemand demand(pass_into(tiles), one_worker());
        EXPECT_EQ(tiles, before);
        demand.draw_all(two_workers());
        EXPECT_EQ(tiles, whole) << texel_info(format).name;
        EXPECT_EQ(demand.statistics(), all);
      }
    }
  }
}

// Reads the texel of a depth image of the same size.
struct ReadDepth : PositionShader {
  const float* depths;
  const TilesOnDemand* tiles;
  int width, height;
  template <class R>
  Fragment<R> fragment(const NoVaryings<R>&, const Pixel<R>& px) const {
    const IntOf<R> x = truncate_to_int(px.x), y = truncate_to_int(px.y);
    if (tiles != nullptr) tiles->require(x, y, x, y);
    const IntOf<R> row = IntOf<R>(height - 1) - y;
    return {vec4<R>(R(gather(depths, IntOf<R>(row * IntOf<R>(width) + x))))};
  }
};

TEST(DepthOnDemand, AShaderReadsTheTilesThatItRequires) {
  const DemandCase c = kCases[1];
  const std::vector<glm::vec4> corners = random_triangles(8), shown{{-1, -1, 0, 1}, {0.4f, -1, 0, 1}, {-1, 0.2f, 0, 1}};
  Image<float> whole = untouched(c), image = untouched(c);
  depth_pass(c, whole, corners).run(one_worker());
  const DepthOnDemand demand(depth_pass(c, image, corners), two_workers());
  const auto picture = [&](const Image<float>& depths, const TilesOnDemand* tiles) {
    Image<glm::vec4> color(c.width, c.height);
    ReadDepth shader;
    shader.depths = depths.data();
    shader.tiles = tiles;
    shader.width = c.width;
    shader.height = c.height;
    Pass pass(c.width, c.height, rgba32f_target(color), DepthTarget{});
    pass.draw(shader, make_vertex_view(stream(shown)));
    pass.run(two_workers());
    return color;
  };
  const Image<glm::vec4> expected = picture(whole, nullptr), shaded = picture(image, &demand.tiles());
  EXPECT_EQ(std::memcmp(expected.data(), shaded.data(), expected.texels().size_bytes()), 0);
  // Its longest edge goes from (140, 0) to (0, 90), below tile (1, 1).
  expect_tiles(c, image, whole, [](int x, int y) { return (y == 0 && x <= 2) || (y == 1 && x == 0); });
}

struct EmitsNothing : PositionShader {
  static constexpr GeometryLayout geometry_layout{};
  template <class R>
  void geometry(const GeometryInput<R, NoVaryings<R>, 3>&, Emitter<R, NoVaryings<R>>&) const {}
};

class DepthOnDemandMisuse : public ThrowingChecksTest {};

TEST_F(DepthOnDemandMisuse, PassesThatCannotBeDrawnByTilesAreRefusedBeforeAnythingIsDrawn) {
  const std::vector<glm::vec4> corners = full_screen();
  Image<float> depth(16, 16);
  Image<glm::u8vec4> color(16, 16);
  const auto message = [&](const ColorTarget& c, const DepthTarget& d, const PassOptions& options, const DrawState& state) {
    return failure_of([&] {
      Pass pass(16, 16, c, d, options);
      pass.draw(ConstantShader{}, make_vertex_view(stream(corners)), state);
      DepthOnDemand(std::move(pass), one_worker());
    });
  };
  const auto contains = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  const DepthTarget target = d32f_target(depth);
  EXPECT_EQ(message({}, target, {}, {}), "");
  EXPECT_TRUE(contains(message(rgba8_target(color), target, {}, {}), "DepthOnDemand: the pass has a color target"));
  // A condition leads to several rounds, and those before the last one are drawn at once.
  EXPECT_TRUE(contains(message(rgba8_target(color), target, {}, {.condition = DrawCondition{.query = 0}}), "has a color target"));
  EXPECT_TRUE(std::ranges::all_of(color.texels(), [](const glm::u8vec4& c) { return c == glm::u8vec4(0); }));
  EXPECT_TRUE(contains(message({}, target, {.samples = 4}, {}), "DepthOnDemand: the pass has several samples"));
  EXPECT_TRUE(contains(message({}, {.format = DepthFormat::d32f}, {}, {}), "DepthOnDemand: the pass stores no depth"));
  EXPECT_TRUE(contains(message({}, {.format = DepthFormat::d32f}, {.layers = 2}, {}), "DepthOnDemand: the pass has several layers"));
  for (const DrawState& state : {DrawState{.query = 0}, DrawState{.timer = 0}, DrawState{.condition = DrawCondition{.query = 0}}})
    EXPECT_TRUE(contains(message({}, target, {}, state), "DepthOnDemand: a draw has a query, a timer or a condition"));
  EXPECT_TRUE(contains(failure_of([&] {
                         Pass pass(16, 16, ColorTarget{}, target);
                         pass.draw_depth(EmitsNothing{}, make_vertex_view(stream(corners)));
                         DepthOnDemand(std::move(pass), one_worker());
                       }),
                       "DepthOnDemand: the shader of a draw emits primitives"));
}

}  // namespace
}  // namespace halfspace::raster_test
