// SPDX-License-Identifier: Apache-2.0
//
// Which vertices, indices and instances a draw uses: ranges, 8-bit indices, restart indices and the first instance.
#include "raster/raster_test.h"
#include "support/throwing_checks.h"

namespace halfspace::raster_test {
namespace {

/// Columns of 8x16 px: vertices 2i and 2i + 1 are the lower and the upper end of the left side of column i.
std::vector<glm::vec4> columns() {
  std::vector<glm::vec4> p;
  for (int i = 0; i < 10; ++i) p.push_back(clip_position({256 * 8 * (i / 2), i % 2 == 0 ? 0 : 256 * 16}, 32, 16));
  return p;
}

/// Outputs the vertex and the instance number of the provoking vertex, and a number per instance.
struct NumberShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    R number;
  };
  template <class R>
  struct Varyings {
    Flat<vec3<R>> numbers;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.numbers.value = vec3<R>(to_real<R>(id.vertex), R(static_cast<float>(id.instance)), in.number);
    vec4<R> p = in.position;
    p.x = p.x + R(0.5f * static_cast<float>(id.instance));
    return p;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.numbers.value, R(1))};
  }
};

class DrawRangeTest : public ThrowingChecksTest {
 protected:
  const std::vector<glm::vec4> positions_ = columns();
  const std::vector<float> numbers_{10, 20, 30, 40, 50, 60, 70, 80, 90, 100};

  /// Draws and returns for each of the four columns the provoking vertex of its lower left triangle, or -1 if nothing is drawn.
  template <class... I>
  std::vector<int> draw(const DrawState& state, const I&... indices) {
    Image<glm::vec4> image(32, 16);
    Pass pass(32, 16, rgba32f_target(image), {});
    pass.draw(NumberShader{}, make_vertex_view(stream(positions_), stream(numbers_)), indices..., state);
    statistics_ = pass.run(one_worker());
    std::vector<int> out;
    for (int x = 0; x < 32; x += 8) out.push_back(pixel(image, x, 1).w == 0.0f ? -1 : static_cast<int>(pixel(image, x, 1).x));
    return out;
  }
  template <class... I>
  std::string failure(const DrawState& state, const I&... indices) {
    return failure_of([&] { draw(state, indices...); });
  }

  PassStatistics statistics_;
};

constexpr Topology kStrip = Topology::triangle_strip;

TEST_F(DrawRangeTest, WithoutIndices) {
  EXPECT_EQ(draw({.topology = kStrip}), (std::vector{2, 4, 6, 8}));
  EXPECT_EQ(draw({.topology = kStrip, .first = 2}), (std::vector{-1, 4, 6, 8}));
  EXPECT_EQ(draw({.topology = kStrip, .first = 2, .count = 6}), (std::vector{-1, 4, 6, -1}));
  EXPECT_EQ(statistics_.vertices_shaded, 6u);
  EXPECT_EQ(draw({.topology = kStrip, .count = 4}), (std::vector{2, -1, -1, -1}));
  EXPECT_EQ(draw({.topology = kStrip, .first = 2, .count = 4, .base_vertex = 2}), (std::vector{-1, -1, 6, -1}));
  EXPECT_EQ(draw({.topology = kStrip, .first = 10}), (std::vector{-1, -1, -1, -1}));
  EXPECT_EQ(draw({.topology = kStrip, .first = 3, .count = 0}), (std::vector{-1, -1, -1, -1}));
}

// A list of triangles takes the path without a lookup of each index.
TEST_F(DrawRangeTest, WithoutIndicesAsAList) {
  std::vector<glm::vec4> p;
  for (int i = 0; i < 100; ++i) {
    for (const Point corner : {Point{0, 0}, Point{384, 0}, Point{0, 384}})  // covers one pixel
      p.push_back(clip_position({corner.x + 256 * (i % 10), corner.y + 256 * (i / 10)}, 16, 16));
  }
  std::vector<float> n(p.size());
  Image<glm::vec4> image(16, 16);
  Pass pass(16, 16, rgba32f_target(image), {});
  pass.draw(NumberShader{}, make_vertex_view(stream(p), stream(n)), {.first = 90, .count = 151});
  EXPECT_EQ(pass.run(one_worker()).primitives_in, 50u);
  for (int i = 0; i < 100; ++i) {
    const bool drawn = i >= 30 && i < 80;
    EXPECT_EQ(pixel(image, i % 10, i / 10), drawn ? glm::vec4(static_cast<float>(3 * i + 2), 0, 0, 1) : glm::vec4(0.0f)) << i;
  }
}

template <class T>
class IndexTypesTest : public DrawRangeTest {};
using IndexTypes = testing::Types<uint8_t, uint16_t, uint32_t>;
TYPED_TEST_SUITE(IndexTypesTest, IndexTypes);

TYPED_TEST(IndexTypesTest, ARangeOfAList) {
  const std::vector<TypeParam> list{0, 1, 2, 3, 6, 7, 8, 9, 2};
  const Indices whole(list, 10);
  const std::vector<int> expected{-1, -1, -1, 8};
  const DrawState state{.topology = kStrip, .first = 4, .count = 4};
  EXPECT_EQ(this->draw(state, whole), expected);
  EXPECT_EQ(this->statistics_.vertices_shaded, 4u);
  EXPECT_EQ(this->draw(state, list), expected);
  const Indices part = whole.range(4, 4);
  EXPECT_EQ(part.first_vertex(), 6u);
  EXPECT_EQ(part.end_vertex(), 10u);
  EXPECT_EQ(this->draw({.topology = kStrip}, part), expected);
  EXPECT_EQ(this->draw({.topology = kStrip, .first = 0, .count = 4}, whole), (std::vector{2, -1, -1, -1}));
  EXPECT_EQ(this->draw({.topology = kStrip, .first = 9}, whole), (std::vector{-1, -1, -1, -1}));
}

TYPED_TEST(IndexTypesTest, RestartsAtAChosenIndex) {
  const TypeParam largest = std::numeric_limits<TypeParam>::max();
  const std::vector<TypeParam> by_five{0, 1, 2, 3, 5, 6, 7, 8, 9}, by_largest{0, 1, 2, 3, largest, 6, 7, 8, 9};
  const std::vector<int> expected{2, -1, -1, 8};
  EXPECT_EQ(this->draw({.topology = kStrip}, Indices(by_five, 10, PrimitiveRestart::at(5))), expected);
  EXPECT_EQ(this->draw({.topology = kStrip}, Indices(by_largest, 10, PrimitiveRestart::on)), expected);
  EXPECT_EQ(this->draw({.topology = kStrip}, Indices(by_largest, 10, PrimitiveRestart::at(largest))), expected);
  const Indices range = Indices(by_five, 10, PrimitiveRestart::at(5)).range(2, 7);
  EXPECT_EQ(range.restarts().size(), 1u);
  EXPECT_EQ(this->draw({.topology = kStrip}, range), (std::vector{-1, -1, -1, 8}));
  // The comparison is with the index before the base vertex is added, and not cut to the index type.
  const std::vector<TypeParam> shifted{0, 1, 2, 3, 5, 4, 5, 6, 7};
  EXPECT_EQ(Indices(shifted, 10, PrimitiveRestart::at(5)).restarts().size(), 2u);
  const std::vector<TypeParam> low{0, 1, 2, 3};
  EXPECT_TRUE(Indices(low, 10, PrimitiveRestart::at(0x00010001)).restarts().empty());
  EXPECT_NE(this->failure({}, Indices::sequential(11)), "");
  EXPECT_NE(failure_of([&] { Indices(by_largest, 10, PrimitiveRestart::at(5)); }), "") << "the largest index is not a restart";
}

TEST_F(DrawRangeTest, TheFirstInstanceSelectsRowsOnly) {
  const std::vector<float> rows{10, 20, 30, 40, 50};
  const auto image_of = [&](uint32_t divisor, uint32_t first) {
    Image<glm::vec4> image(32, 16);
    Pass pass(32, 16, rgba32f_target(image), {});
    pass.draw(NumberShader{}, make_vertex_view(stream(positions_), per_instance(stream(rows), divisor)),
              {.topology = kStrip, .count = 4, .instances = 4, .base_instance = first});
    pass.run(one_worker());
    return image;
  };
  for (const uint32_t first : {0u, 1u}) {
    const Image<glm::vec4> each = image_of(1, first), half = image_of(2, first + 2);
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(pixel(each, 8 * i, 1), glm::vec4(2, i, rows[first + static_cast<uint32_t>(i)], 1));
      EXPECT_EQ(pixel(half, 8 * i, 1), glm::vec4(2, i, rows[first + 2 + static_cast<uint32_t>(i) / 2], 1));
    }
  }
}

TEST_F(DrawRangeTest, InstancesNeedRows) {
  const std::vector<float> rows(5);
  const auto message = [&](uint32_t divisor, uint32_t instances, uint32_t first) {
    Image<glm::vec4> image(32, 16);
    Pass pass(32, 16, rgba32f_target(image), {});
    return failure_of([&] {
      pass.draw(NumberShader{}, make_vertex_view(stream(positions_), per_instance(stream(rows), divisor)),
                {.instances = instances, .base_instance = first});
    });
  };
  EXPECT_EQ(message(1, 5, 0), "");
  EXPECT_NE(message(1, 6, 0).find("more instances than rows"), std::string::npos);
  EXPECT_EQ(message(1, 2, 3), "");
  EXPECT_NE(message(1, 2, 4), "");
  EXPECT_EQ(message(3, 15, 0), "");
  EXPECT_NE(message(3, 16, 0), "");
  EXPECT_EQ(message(3, 9, 2), "");
  EXPECT_NE(message(3, 10, 2), "");
  EXPECT_NE(message(1, 1, 0xffffffffu), "");
  EXPECT_EQ(message(1, 0, 0xffffffffu), "") << "no instance, no row";
  EXPECT_NE(message(1, 0xffffffffu, 0xffffffffu), "");
}

TEST_F(DrawRangeTest, RangesMustBeInTheList) {
  const std::vector<uint32_t> list{0, 1, 2, 3};
  const Indices indices(list, 10);
  for (const DrawState& state : {DrawState{.first = 5}, DrawState{.first = 1, .count = 4}, DrawState{.first = 4, .count = 1},
                                 DrawState{.count = 5}, DrawState{.first = 0xffffffffu, .count = 2}}) {
    EXPECT_NE(failure(state, indices).find("DrawState: `"), std::string::npos);
    EXPECT_NE(failure(state, list).find("DrawState: `"), std::string::npos);
  }
  EXPECT_NE(failure({.first = 11}), "");
  EXPECT_NE(failure({.first = 9, .count = 2}), "");
  EXPECT_NE(failure({.first = 8, .base_vertex = 1}), "") << "vertex 10";
  EXPECT_NE(failure_of([&] { indices.range(5, 0); }), "");
  EXPECT_NE(failure_of([&] { indices.range(2, 3); }), "");
  EXPECT_EQ(failure_of([&] { indices.range(4, 0); }), "");
}

TEST_F(DrawRangeTest, AnEmptyListIgnoresTheBaseVertex) {
  const std::vector<uint32_t> none;
  EXPECT_EQ(failure({.base_vertex = 100}, none), "");
  EXPECT_EQ(failure({.base_vertex = -1}, none), "");
  const std::vector<uint8_t> only_restarts{255, 255};
  EXPECT_EQ(failure({.base_vertex = -1}, Indices(only_restarts, 10, PrimitiveRestart::on)), "");
}

}  // namespace
}  // namespace halfspace::raster_test
