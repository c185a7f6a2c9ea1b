// SPDX-License-Identifier: Apache-2.0
//
// Which element types a vertex stream accepts. tests/compile has the refused ones that users meet first.
#include <array>

#include "halfspace/core/vec.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

using detail::consists_of_floats;

struct PlainVertex {
  glm::vec3 position;
  glm::vec2 uv;
};
struct Derived : PlainVertex {
  float weight;
};
struct Nested {
  PlainVertex vertex;
  float weight;
};
struct Arrays {
  float position[3], matrix[16];
  std::array<glm::vec2, 2> uvs;
};
struct Packed {
  glm::vec3 position;
  uint32_t color;
};
struct Bytes {
  float x;
  uint8_t r, g, b, a;
};
struct NestedInteger {
  PlainVertex vertex;
  int joint;
};
struct IntegerAtTheEnd {
  float numbers[20];
  int32_t last;
};
struct IntegerArrays {
  float x[2];
  std::array<glm::ivec2, 2> y;
};
enum class Kind : uint32_t {};

static_assert(consists_of_floats<float>() && consists_of_floats<glm::vec3>() && consists_of_floats<glm::mat4>());
static_assert(consists_of_floats<vec4<float>>() && consists_of_floats<std::array<float, 3>>() && consists_of_floats<float[3]>());
static_assert(consists_of_floats<PlainVertex>() && consists_of_floats<Derived>() && consists_of_floats<Nested>() &&
              consists_of_floats<Arrays>());
static_assert(consists_of_floats<ConstantShader::Attributes<float>>());
static_assert(!consists_of_floats<uint32_t>() && !consists_of_floats<int32_t>() && !consists_of_floats<double>() &&
              !consists_of_floats<Kind>());
static_assert(!consists_of_floats<glm::ivec4>() && !consists_of_floats<glm::uvec2>() && !consists_of_floats<glm::u8vec4>());
static_assert(!consists_of_floats<Packed>() && !consists_of_floats<Bytes>() && !consists_of_floats<NestedInteger>());
static_assert(!consists_of_floats<IntegerAtTheEnd>() && !consists_of_floats<IntegerArrays>());

TEST(StreamTypes, AMemberOfAStructWithIntegersCanBeAStream) {
  const std::vector<Packed> vertices{{{1, 2, 3}, 7}, {{4, 5, 6}, 8}};
  const StreamOf<glm::vec3> positions = stream(vertices, &Packed::position);
  EXPECT_EQ(positions.stride, 16);
  std::array<float, 3> second{};
  read_row(positions, 1, second.data());
  EXPECT_EQ(second, (std::array{4.0f, 5.0f, 6.0f}));
}

}  // namespace
}  // namespace halfspace::raster_test
