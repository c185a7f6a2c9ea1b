// SPDX-License-Identifier: Apache-2.0
//
// Formats of vertex streams. All codes of the small formats are compared with the definitions of OpenGL 4.6, sections 2.3.4 and 2.3.5,
// computed in long double, and pictures with those of the same numbers given as floats.
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "halfspace/raster/naive.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

/// Reads all elements of a stream.
std::vector<float> numbers_of(const VertexStream& s) {
  std::vector<float> out(s.count * static_cast<std::size_t>(s.components));
  std::vector<uint32_t> rows(s.count);
  for (uint32_t i = 0; i < rows.size(); ++i) rows[i] = i;
  read_rows(s, rows, out.data());
  return out;
}

float nearest(long double x) { return static_cast<float>(x); }
bool same_bits(float a, float b) { return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b); }

template <class T>
std::vector<T> all_codes() {
  std::vector<T> codes;
  for (int64_t c = std::numeric_limits<T>::min(); c <= std::numeric_limits<T>::max(); ++c) codes.push_back(static_cast<T>(c));
  return codes;
}

/// Checks integers of type T, read in all three ways.
template <class T>
void expect_integers(const std::vector<T>& codes) {
  const std::vector<float> normalized = numbers_of(stream<ReadAs::normalized>(codes)), floats = numbers_of(stream<ReadAs::floats>(codes)),
                           integers = numbers_of(stream<ReadAs::integers>(codes));
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const auto c = static_cast<long double>(codes[i]);
    const long double largest = static_cast<long double>(std::numeric_limits<T>::max());
    ASSERT_EQ(normalized[i], nearest(std::max(c / largest, -1.0L))) << +codes[i];
    ASSERT_EQ(floats[i], nearest(c)) << +codes[i];
    ASSERT_EQ(std::bit_cast<int32_t>(integers[i]), static_cast<int32_t>(codes[i])) << +codes[i];
  }
}

TEST(VertexFormats, EveryCodeOfSmallIntegers) {
  expect_integers(all_codes<uint8_t>());
  expect_integers(all_codes<int8_t>());
  expect_integers(all_codes<uint16_t>());
  expect_integers(all_codes<int16_t>());
}

TEST(VertexFormats, IntegersOf32Bits) {
  std::vector<uint32_t> codes{0,          1,          2,          0x00ffffff, 0x01000001, 0x7f800001,
                              0x7fffffff, 0x80000000, 0x80000001, 0xff800001, 0xfffffffe, 0xffffffff};
  Random random(1);
  for (int i = 0; i < 100000; ++i) codes.push_back(random.bits() >> random.below(32));
  std::vector<int32_t> negative;
  for (const uint32_t c : codes) negative.push_back(static_cast<int32_t>(c));
  expect_integers(codes);
  expect_integers(negative);
}

TEST(VertexFormats, EveryHalf) {
  const std::vector<uint16_t> codes = all_codes<uint16_t>();
  const std::vector<float> numbers = numbers_of(stream<ReadAs::halves>(codes));
  for (const uint16_t c : codes) {
    const int exponent = c >> 10 & 31, significand = c & 0x3ff;
    const float sign = c >> 15 != 0 ? -1.0f : 1.0f;
    if (exponent == 31 && significand != 0) {
      EXPECT_TRUE(std::isnan(numbers[c])) << c;
      continue;
    }
    const float size = exponent == 31  ? std::numeric_limits<float>::infinity()
                       : exponent == 0 ? std::ldexp(static_cast<float>(significand), -24)
                                       : std::ldexp(static_cast<float>(1024 + significand), exponent - 25);
    ASSERT_TRUE(same_bits(numbers[c], sign * size)) << c;
  }
}

TEST(VertexFormats, EveryCodeOfPackedNumbers) {
  std::vector<Uint2_10_10_10> unsigned_words;
  std::vector<Int2_10_10_10> signed_words;
  const auto field = [](uint32_t i, int k) {
    return (i * static_cast<uint32_t>(2 * k + 1) + static_cast<uint32_t>(k)) & (k < 3 ? 1023u : 3u);
  };
  for (uint32_t i = 0; i < 1024; ++i) {
    uint32_t word = 0;
    for (int k = 0; k < 4; ++k) word |= field(i, k) << 10 * k;
    unsigned_words.push_back({word});
    signed_words.push_back({word});
  }
  const std::vector<float> unorm = numbers_of(stream<ReadAs::normalized>(unsigned_words)),
                           uint = numbers_of(stream<ReadAs::floats>(unsigned_words)),
                           snorm = numbers_of(stream<ReadAs::normalized>(signed_words)),
                           sint = numbers_of(stream<ReadAs::floats>(signed_words));
  for (uint32_t i = 0; i < 1024; ++i) {
    for (int k = 0; k < 4; ++k) {
      const int bits = k < 3 ? 10 : 2, code = static_cast<int>(field(i, k)), negative = code - (code >> (bits - 1) << bits);
      const std::size_t at = 4 * i + static_cast<std::size_t>(k);
      ASSERT_EQ(unorm[at], nearest(code / static_cast<long double>((1 << bits) - 1)));
      ASSERT_EQ(uint[at], static_cast<float>(code));
      ASSERT_EQ(snorm[at], nearest(std::max(negative / static_cast<long double>((1 << (bits - 1)) - 1), -1.0L)));
      ASSERT_EQ(sint[at], static_cast<float>(negative));
    }
  }
}

TEST(VertexFormats, DoublesAreRoundedToTheNearestFloat) {
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<double> exact{0.0, -0.0, 1.0, -2.5, 0x1p-149, 0x1.fffffep127, inf, -inf};
  const std::vector<float> same = numbers_of(stream<ReadAs::floats>(exact));
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_TRUE(same_bits(same[i], static_cast<float>(exact[i]))) << exact[i];
  // Below, at and above the middle of two floats, in the range of normal and of denormal floats and at its end.
  const std::vector<double> inexact{0x1.000000ffffffp0, 0x1.000001p0, 0x1.00000100001p0, 0x1.000003p0,   -0x1.000003p0,
                                    0x1p-150,           0x1.8p-149,   0x1.00001p-150,    0x1.ffffffp127, 1e300};
  const std::vector<float> expected{1.0f, 1.0f,      0x1.000002p0f, 0x1.000004p0f,           -0x1.000004p0f,
                                    0.0f, 0x1p-148f, 0x1p-149f,     static_cast<float>(inf), static_cast<float>(inf)};
  const std::vector<float> rounded = numbers_of(stream<ReadAs::floats>(inexact));
  for (std::size_t i = 0; i < inexact.size(); ++i) EXPECT_TRUE(same_bits(rounded[i], expected[i])) << i << ' ' << rounded[i];
  const std::vector<double> nan{std::numeric_limits<double>::quiet_NaN()};
  EXPECT_TRUE(std::isnan(numbers_of(stream<ReadAs::floats>(nan))[0]));
}

TEST(VertexFormats, FloatsKeepTheirBits) {
  const std::vector<uint32_t> bits{0x7f800001, 0xffffffff, 0x80000000, 1, 0x3f800000};
  std::vector<std::byte> bytes(1 + 5 * bits.size());
  for (std::size_t i = 0; i < bits.size(); ++i) std::memcpy(&bytes[1 + 5 * i], &bits[i], 4);
  std::vector<uint32_t> read(bits.size());
  const VertexStream s{bytes.data() + 1, 5, 1, bits.size()};
  EXPECT_FALSE(is_read_in_place(s));
  for (std::size_t i = 0; i < bits.size(); ++i) read_row(s, i, reinterpret_cast<float*>(&read[i]));
  EXPECT_EQ(read, bits);
}

// ---- the vertex stage ----------------------------------------------------------------------------------------------

/// Outputs the attributes of a vertex.
struct EchoShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec3<R> a;
    vec2<R> b;
    R c;
  };
  template <class R>
  struct Varyings {
    vec3<R> a;
    vec2<R> b;
    R c;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {in.a, in.b, in.c};
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.a, in.b.x * in.b.y + in.c)};
  }
};

/// 700 random vertices, which are several batches of the vertex stage and no multiple of its packets.
struct Vertices {
  std::vector<glm::vec4> positions;
  std::vector<glm::u8vec3> a;
  std::vector<glm::u16vec2> b;  // halves
  std::vector<double> c;
  std::vector<glm::vec3> a_floats;
  std::vector<glm::vec2> b_floats;
  std::vector<float> c_floats;

  Vertices() {
    Random r(5);
    for (int i = 0; i < 700; ++i) {
      positions.push_back({r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f), r.real(-1.5f, 1.0f), r.real(0.5f, 1.5f)});
      a.push_back({r.bits(), r.bits(), r.bits()});
      b.push_back({r.bits() & 0x3fff, r.bits() & 0x3fff});  // 0 to 2
      c.push_back(r.real(-1.0, 1.0));
      a_floats.push_back(glm::vec3(a.back()) / 255.0f);
      b_floats.push_back({half_to_float(b.back().x), half_to_float(b.back().y)});
      c_floats.push_back(static_cast<float>(c.back()));
    }
  }
  auto float_view() const { return make_vertex_view(stream(positions), stream(a_floats), stream(b_floats), stream(c_floats)); }
  auto formatted_view() const {
    return make_vertex_view(stream(positions), stream<ReadAs::normalized>(a), stream<ReadAs::halves>(b), stream<ReadAs::floats>(c));
  }
};

/// Compares the output of the vertex stage for two views.
void expect_same_vertices(const VertexView& expected, const VertexView& actual) {
  const Rect viewport{0, 0, 100, 100};
  const ShadedVertices x = shade(EchoShader{}, expected, viewport), y = shade(EchoShader{}, actual, viewport);
  ASSERT_EQ(x.count, y.count);
  EXPECT_EQ(std::memcmp(x.varyings.get(), y.varyings.get(), x.count * static_cast<std::size_t>(x.varying_count) * sizeof(float)), 0);
  EXPECT_EQ(std::memcmp(x.screen.get(), y.screen.get(), x.count * sizeof(ScreenVertex)), 0);
  EXPECT_EQ(std::memcmp(x.outcodes.get(), y.outcodes.get(), x.count * sizeof(Outcode)), 0);
}

TEST(VertexFormats, SeparateStreamsGiveTheVerticesOfFloats) {
  const Vertices v;
  EXPECT_FALSE(v.float_view().needs_conversion);
  EXPECT_TRUE(v.formatted_view().needs_conversion);
  expect_same_vertices(v.float_view(), v.formatted_view());
}

struct PackedVertex {
  glm::vec4 position;
  double c;
  uint16_t b[2];
  std::array<uint8_t, 3> a;
};

TEST(VertexFormats, InterleavedMembersGiveTheVerticesOfFloats) {
  const Vertices v;
  std::vector<PackedVertex> packed;
  for (std::size_t i = 0; i < v.positions.size(); ++i)
    packed.push_back({v.positions[i], v.c[i], {v.b[i].x, v.b[i].y}, {v.a[i].x, v.a[i].y, v.a[i].z}});
  expect_same_vertices(
      v.float_view(), make_vertex_view(stream(packed, &PackedVertex::position), stream<ReadAs::normalized>(packed, &PackedVertex::a),
                                       stream<ReadAs::halves>(packed, &PackedVertex::b), stream<ReadAs::floats>(packed, &PackedVertex::c)));
}

TEST(VertexFormats, NothingNeedsToBeAligned) {
  const Vertices v;
  constexpr std::size_t stride = 16 + 3 + 4 + 8 + 2;
  static_assert(stride % 2 == 1);
  for (const std::size_t offset : {0u, 1u, 2u, 3u}) {
    std::vector<std::byte> bytes(offset + stride * v.positions.size());
    for (std::size_t i = 0; i < v.positions.size(); ++i) {
      std::byte* row = bytes.data() + offset + stride * i;
      std::memcpy(row, &v.positions[i], 16);
      std::memcpy(row + 16, &v.a[i], 3);
      std::memcpy(row + 19, &v.b[i], 4);
      std::memcpy(row + 23, &v.c[i], 8);
    }
    const auto part = [&](std::size_t at, int components, ComponentType type, ReadAs as) {
      return VertexStream{bytes.data() + offset + at, static_cast<int32_t>(stride), components, v.positions.size(), 0, type, as};
    };
    expect_same_vertices(
        v.float_view(),
        make_vertex_view(part(0, 4, ComponentType::float32, ReadAs::floats), part(16, 3, ComponentType::uint8, ReadAs::normalized),
                         part(19, 2, ComponentType::float16, ReadAs::floats), part(23, 1, ComponentType::float64, ReadAs::floats)));
  }
}

TEST(VertexFormats, MissingComponentsAreZeroAndTheFourthIsOne) {
  const std::vector<float> scalars{3.0f, 4.0f};
  const std::vector<glm::vec2> pairs{{3.0f, 5.0f}, {4.0f, 6.0f}};
  const std::vector<glm::u8vec3> bytes{{255, 0, 51}};
  const std::vector<glm::i16vec2> integers{{-7, 8}};
  EXPECT_EQ(numbers_of(with_components<2>(stream(scalars))), (std::vector<float>{3, 0, 4, 0}));
  EXPECT_EQ(numbers_of(with_components<4>(stream(scalars))), (std::vector<float>{3, 0, 0, 1, 4, 0, 0, 1}));
  EXPECT_EQ(numbers_of(with_components<3>(stream(pairs))), (std::vector<float>{3, 5, 0, 4, 6, 0}));
  EXPECT_EQ(numbers_of(with_components<4>(stream<ReadAs::normalized>(bytes))), (std::vector<float>{1, 0, 0.2f, 1}));
  const std::vector<float> bits = numbers_of(with_components<4>(stream<ReadAs::integers>(integers)));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(std::bit_cast<int32_t>(bits[k]), (std::array{-7, 8, 0, 1})[k]) << k;
  EXPECT_EQ(numbers_of(with_components<4>(with_components<3>(stream(pairs)))), (std::vector<float>{3, 5, 0, 1, 4, 6, 0, 1}));
  EXPECT_EQ(row_bytes(with_components<4>(stream(pairs))), 8u);  // nothing is read behind the row
}

TEST(VertexFormats, MissingComponentsGiveTheVerticesOfWholeRows) {
  const Vertices v;
  std::vector<glm::vec2> short_positions;
  std::vector<glm::vec4> positions;
  for (const glm::vec4& p : v.positions) {
    short_positions.emplace_back(p);
    positions.push_back({p.x, p.y, 0.0f, 1.0f});
  }
  const auto view = [&](const auto& position) {
    return make_vertex_view(position, stream(v.a_floats), stream(v.b_floats), stream(v.c_floats));
  };
  expect_same_vertices(view(stream(positions)), view(with_components<4>(stream(short_positions))));
}

TEST(VertexFormats, BgraExchangesTheFirstAndTheThirdComponent) {
  const std::vector<glm::u8vec4> bytes{{51, 102, 255, 0}};
  EXPECT_EQ(numbers_of(bgra(stream<ReadAs::normalized>(bytes))), (std::vector<float>{1.0f, 0.4f, 0.2f, 0.0f}));
  const std::vector<Uint2_10_10_10> packed{{1023u | 3u << 30}};
  EXPECT_EQ(numbers_of(bgra(stream<ReadAs::normalized>(packed))), (std::vector<float>{0.0f, 0.0f, 1.0f, 1.0f}));
}

TEST(VertexFormats, AStrideOfZeroIsAConstantAttribute) {
  Vertices v;
  const glm::u8vec3 one{1, 128, 255};
  v.a_floats.assign(v.positions.size(), glm::vec3(one) / 255.0f);
  const VertexStream constant{
      std::as_bytes(std::span(&one, 1)).data(), 0, 3, v.positions.size(), 0, ComponentType::uint8, ReadAs::normalized};
  expect_same_vertices(v.float_view(), make_vertex_view(stream(v.positions), constant, stream(v.b_floats), stream(v.c_floats)));
}

/// Draws with gaps between the indices, with instances and clipped triangles.
Image<glm::vec4> picture_of(const VertexView& view) {
  std::vector<uint16_t> list;
  Random r(6);
  for (int i = 0; i < 240; ++i) list.push_back(static_cast<uint16_t>(r.below(600) | 1));
  Image<glm::vec4> image(120, 90);
  Image<float> depth(120, 90);
  Pass pass(120, 90, rgba32f_target(image), d32f_target(depth));
  pass.draw(EchoShader{}, view, list, {.base_vertex = 50, .instances = 3, .base_instance = 4});
  EXPECT_GT(pass.run(one_worker()).clipped, 0u);
  return image;
}

TEST(VertexFormats, PicturesAreThoseOfFloats) {
  const Vertices v;
  const Image<glm::vec4> expected = picture_of(v.float_view());
  EXPECT_EQ(expected, picture_of(v.formatted_view()));
  const Image<glm::vec4> by_instance = picture_of(
      make_vertex_view(stream(v.positions), per_instance(stream(v.a_floats), 2), stream(v.b_floats), per_instance(stream(v.c_floats))));
  EXPECT_NE(expected, by_instance);
  EXPECT_EQ(by_instance, picture_of(make_vertex_view(stream(v.positions), per_instance(stream<ReadAs::normalized>(v.a), 2),
                                                     stream(v.b_floats), per_instance(stream<ReadAs::floats>(v.c)))));
}

template <class R>
NaiveTarget<R> naive_picture(const VertexView& view) {
  NaiveTarget<R> target(60, 50, vec4<R>(R(0)), R(1));
  draw_naive(target, EchoShader{}, view, Indices::sequential(view.vertex_count), {.first = 6, .count = 90, .base_vertex = 3});
  return target;
}

TEST(VertexFormats, TheNaivePipelineReadsThem) {
  const Vertices v;
  Image<glm::vec4> image(60, 50);
  Image<float> depth(60, 50);
  Pass pass(60, 50, rgba32f_target(image), d32f_target(depth));
  pass.draw(EchoShader{}, v.formatted_view(), {.first = 6, .count = 90, .base_vertex = 3});
  pass.run(one_worker());
  const NaiveTarget<float> naive = naive_picture<float>(v.formatted_view());
  EXPECT_EQ(std::memcmp(image.data(), naive.color.data(), 60 * 50 * sizeof(glm::vec4)), 0);
  EXPECT_EQ(depth, naive.depth);
  const NaiveTarget<double> of_floats = naive_picture<double>(v.float_view()), of_formats = naive_picture<double>(v.formatted_view());
  EXPECT_EQ(of_floats.depth, of_formats.depth);
  EXPECT_EQ(std::memcmp(of_floats.color.data(), of_formats.color.data(), 60 * 50 * sizeof(vec4<double>)), 0);
}

}  // namespace
}  // namespace halfspace::raster_test
