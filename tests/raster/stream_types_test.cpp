// SPDX-License-Identifier: Apache-2.0
//
// Which element types a vertex stream accepts. tests/compile has the refused ones that users meet first.
#include <array>

#include "halfspace/core/glsl_matrix.h"
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

// ---- comparison with the attributes of a shader ------------------------------------------------------------------------

template <template <class> class A, class... E>
constexpr bool fits = detail::streams_match<A<float>, E...>();

template <class R>
struct PositionUv {
  vec3<R> position;
  vec2<R> uv;
};
template <class R>
struct UvPosition {
  vec2<R> uv;
  vec3<R> position;
};
template <class R>
struct WithWeight {
  vec3<R> position;
  vec2<R> uv;
  R weight;
};
template <class R>
struct WithMatrix {
  vec3<R> position;
  std::array<vec4<R>, 4> matrix;
  std::array<vec2<R>, 2> uvs;
};
template <class R>
struct WithSmallMatrix {
  vec3<R> position;
  mat2<R> matrix;
};
template <class R>
struct WithJoints {
  vec3<R> position;
  std::array<IntOf<R>, 4> joints;
  IntOf<R> id;
};
struct VectorsInArrays {
  glm::vec3 position;
  glm::vec4 columns[4];
  std::array<glm::vec2, 2> uvs;
};
struct Matrices {
  glm::vec3 position;
  glm::mat4 matrix;
  float uvs[4];
};
struct ThreeAndTwo {
  float x, y, z, u, v;
};

static_assert(fits<PositionUv, PlainVertex> && fits<PositionUv, PositionUv<float>> && fits<PositionUv, glm::vec3, glm::vec2>);
static_assert(!fits<UvPosition, PlainVertex>, "trap: five floats, but other members");
static_assert(!fits<UvPosition, PositionUv<float>> && fits<UvPosition, UvPosition<float>>);
static_assert(!fits<UvPosition, glm::vec3, glm::vec2> && !fits<PositionUv, glm::vec4, float> && !fits<PositionUv, glm::vec3>);
static_assert(!fits<PositionUv, PlainVertex, float> && !fits<PositionUv, glm::vec2, PlainVertex>);
static_assert(fits<PositionUv, ThreeAndTwo>, "numbers in a row can be an array of C");
static_assert(!fits<PositionUv, float, float, float, glm::vec2>, "a vector comes from one stream");
static_assert(fits<WithWeight, Derived> && fits<WithWeight, Nested> && fits<WithWeight, PlainVertex, float>);
static_assert(fits<WithMatrix, VectorsInArrays> && fits<WithMatrix, Matrices>);
static_assert(fits<WithMatrix, glm::vec3, glm::mat4, std::array<glm::vec2, 2>>);
static_assert(fits<WithMatrix, glm::vec3, glm::vec4, glm::vec4, glm::vec4, glm::vec4, glm::vec2, glm::vec2>);
static_assert(!fits<WithMatrix, glm::vec3, glm::mat3, std::array<glm::vec2, 2>>);
static_assert(fits<WithSmallMatrix, glm::vec3, glm::mat2> && fits<WithSmallMatrix, glm::vec3, std::array<glm::vec2, 2>>);
static_assert(fits<WithSmallMatrix, glm::vec3, glm::vec2, glm::vec2> && fits<WithSmallMatrix, glm::vec3, mat2<float>>);
static_assert(!fits<WithSmallMatrix, glm::vec3, glm::vec4> && !fits<WithSmallMatrix, glm::vec3, glm::mat3>);
static_assert(fits<WithJoints, glm::vec3, glm::ivec4, int32_t>);
static_assert(!fits<WithJoints, glm::vec3, glm::vec4, int32_t> && !fits<WithJoints, glm::vec3, glm::ivec4, float>);
static_assert(!fits<PositionUv, glm::ivec3, glm::vec2>);

// What a shader receives of each kind of stream.
template <class Stream>
using ElementOf = typename Stream::Element;
template <ReadAs as, class T>
using Read = ElementOf<decltype(stream<as>(std::span<const T>()))>;
static_assert(std::is_same_v<Read<ReadAs::normalized, glm::u8vec4>, glm::vec4> && std::is_same_v<Read<ReadAs::halves, uint16_t>, float>);
static_assert(std::is_same_v<Read<ReadAs::floats, glm::dvec3>, glm::vec3> && std::is_same_v<Read<ReadAs::floats, uint32_t>, float>);
static_assert(std::is_same_v<Read<ReadAs::integers, glm::u8vec4>, glm::ivec4> && std::is_same_v<Read<ReadAs::integers, uint32_t>, int32_t>);
static_assert(std::is_same_v<Read<ReadAs::normalized, Int2_10_10_10>, glm::vec4>);
static_assert(std::is_same_v<Read<ReadAs::normalized, std::array<int16_t, 3>>, glm::vec3>);
static_assert(std::is_same_v<Read<ReadAs::floats, glm::dmat3>, std::array<float, 9>>);
static_assert(std::is_same_v<Read<ReadAs::floats, glm::dmat2>, std::array<float, 4>>);
static_assert(fits<WithSmallMatrix, glm::vec3, Read<ReadAs::floats, glm::dmat2>>);

// Which numbers can be read in which way.
using detail::can_read;
static_assert(!can_read<float, ReadAs::normalized>() && !can_read<float, ReadAs::integers>() && can_read<float, ReadAs::floats>());
static_assert(!can_read<int64_t, ReadAs::integers>() && !can_read<bool, ReadAs::floats>() && !can_read<int16_t, ReadAs::halves>());
static_assert(!can_read<Uint2_10_10_10, ReadAs::integers>() && can_read<Uint2_10_10_10, ReadAs::floats>());
static_assert(!can_read<Packed, ReadAs::normalized>() && !can_read<Kind, ReadAs::integers>());

// ---- varyings ------------------------------------------------------------------------------------------------------------

template <class R>
struct FlatIntegers {
  vec3<R> a;
  Flat<IntOf<R>> b;
  Flat<std::array<IntOf<R>, 2>> c;
};
template <class R>
struct SmoothInteger {
  IntOf<R> a;
};
template <class R>
struct LinearInteger {
  NoPerspective<IntOf<R>> a;
};
template <class R>
struct CentroidIntegers {
  Centroid<std::array<IntOf<R>, 2>> a;
};
static_assert(kComponents<FlatIntegers<Real>> == 6 && kIntegerComponents<FlatIntegers<Real>> == 0b111000);
static_assert(kHasIntegers<FlatIntegers<Real>> && !kInterpolatesIntegers<FlatIntegers<Real>> && !kHasIntegers<PositionUv<Real>>);
static_assert(kInterpolatesIntegers<SmoothInteger<float>> && kInterpolatesIntegers<LinearInteger<float>> &&
              kInterpolatesIntegers<CentroidIntegers<float>>);

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
