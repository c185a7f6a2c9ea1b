// SPDX-License-Identifier: Apache-2.0
//
// Integers, arrays and many members as attributes and varyings.
#include <bit>
#include <cstring>
#include <limits>

#include "halfspace/raster/naive.h"
#include "raster/raster_test.h"
#include "support/throwing_checks.h"

namespace halfspace::raster_test {
namespace {

/// Integers that are not changed on their way: as floats they are denormal, infinite, signaling and quiet NaNs, and zeros.
constexpr std::array<uint32_t, 16> kBits{0,          1,          0x7fffff,   0x800000,   0x7f800000, 0x7f800001, 0x7fbfffff, 0x7fc00000,
                                         0x7fffffff, 0x80000000, 0x80000001, 0xff800000, 0xff800001, 0xffbfffff, 0xffc00000, 0xffffffff};

/// Copies an integer from the attributes to the target. Also used with its index as a second integer, to tell the vertices apart.
struct BitsShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    IntOf<R> bits;
    std::array<IntOf<R>, 2> more;
  };
  template <class R>
  struct Varyings {
    R unused;
    Flat<IntOf<R>> bits;
    Flat<std::array<IntOf<R>, 2>> more;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.unused = in.position.x;
    out.bits.value = in.bits;
    out.more.value = in.more;
    return in.position;
  }
  template <class R>
  TypedFragment<R, uvec4<R>> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {uvec4<R>(UintOf<R>(in.bits.value ^ in.more.value[0] ^ in.more.value[1]))};
  }
};

/// One point per pixel, or a large triangle, or one that is clipped.
enum class PrimitiveKind { points, triangles, clipped_triangles };
constexpr int kWidth = 32;

std::vector<glm::vec4> positions_of(PrimitiveKind shape) {
  std::vector<glm::vec4> p;
  for (int i = 0; i < static_cast<int>(kBits.size()); ++i) {
    if (shape == PrimitiveKind::points) {
      p.push_back(clip_position({256 * i + 128, 128}, kWidth, kWidth));
      continue;
    }
    // A triangle that covers row i. If it is clipped, its first vertex is behind the eye, in the plane of the lower edge of the row.
    p.push_back(clip_position({-256 * 40, 256 * i}, kWidth, kWidth));
    p.push_back(clip_position({256 * 40, 256 * i}, kWidth, kWidth));
    p.push_back(clip_position({256 * 40, 256 * (i + 1)}, kWidth, kWidth));
    if (shape == PrimitiveKind::clipped_triangles) p[p.size() - 3] = {-1.9f, -0.25f * p[p.size() - 2].y, -0.5f, -0.25f};
  }
  return p;
}

template <class R>
std::vector<R> per_corner(const std::vector<R>& values, std::size_t corners) {
  std::vector<R> out;
  for (const R& v : values) out.insert(out.end(), corners, v);
  return out;
}

TEST(IntegerAttributes, KeepTheirBitsThroughTheWholePipeline) {
  for (const PrimitiveKind shape : {PrimitiveKind::points, PrimitiveKind::triangles, PrimitiveKind::clipped_triangles}) {
    const std::vector<glm::vec4> p = positions_of(shape);
    const std::vector<uint32_t> bits = per_corner(std::vector<uint32_t>(kBits.begin(), kBits.end()), p.size() / kBits.size());
    const std::vector<glm::i16vec2> zeros(p.size(), glm::i16vec2(0));
    Image<uint32_t> image(kWidth, kWidth);
    Pass pass(kWidth, kWidth, r32ui_target(image, 42), {});
    pass.draw(BitsShader{}, make_vertex_view(stream(p), stream<ReadAs::integers>(bits), stream<ReadAs::integers>(zeros)),
              {.topology = shape == PrimitiveKind::points ? Topology::points : Topology::triangles});
    const PassStatistics s = pass.run(one_worker());
    EXPECT_EQ(s.clipped, shape == PrimitiveKind::clipped_triangles ? kBits.size() : 0u);
    std::size_t found = 0;
    for (const uint32_t expected : kBits)
      found += std::find(image.data(), image.data() + kWidth * kWidth, expected) != image.data() + kWidth * kWidth ? 1 : 0;
    EXPECT_EQ(found, kBits.size()) << static_cast<int>(shape);
    for (int i = 0; shape == PrimitiveKind::points && i < static_cast<int>(kBits.size()); ++i)
      EXPECT_EQ(pixel(image, i, 0), kBits[static_cast<std::size_t>(i)]);
  }
}

TEST(IntegerAttributes, SmallIntegersAreExtended) {
  const std::vector<glm::vec4> p = positions_of(PrimitiveKind::points);
  std::vector<int8_t> signs;
  std::vector<std::array<uint16_t, 2>> pairs;
  for (int i = 0; i < 16; ++i) {
    signs.push_back(static_cast<int8_t>(-i * 8));
    pairs.push_back({static_cast<uint16_t>(65535 - i), static_cast<uint16_t>(i * 300)});
  }
  Image<uint32_t> image(kWidth, kWidth);
  Pass pass(kWidth, kWidth, r32ui_target(image), {});
  pass.draw(BitsShader{}, make_vertex_view(stream(p), stream<ReadAs::integers>(signs), stream<ReadAs::integers>(pairs)),
            {.topology = Topology::points});
  pass.run(one_worker());
  for (int i = 0; i < 16; ++i) {
    const auto expected = static_cast<uint32_t>(-i * 8) ^ static_cast<uint32_t>(65535 - i) ^ static_cast<uint32_t>(i * 300);
    EXPECT_EQ(pixel(image, i, 0), expected) << i;
  }
}

/// Converts integers to colors, so that the naive pipeline can draw them in float and in double.
struct IntegerColorShader : BitsShader {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(to_real<R>(in.bits.value), to_real<R>(in.more.value[0]), to_real<R>(in.more.value[1]), in.unused)};
  }
};

TEST(IntegerAttributes, TheNaivePipelineHasTheSame) {
  for (const PrimitiveKind shape : {PrimitiveKind::triangles, PrimitiveKind::clipped_triangles}) {
    const std::vector<glm::vec4> p = positions_of(shape);
    std::vector<uint32_t> bits;
    std::vector<glm::i8vec2> more;
    for (std::size_t i = 0; i < p.size(); ++i) {
      bits.push_back(static_cast<uint32_t>(i * 1000003));
      more.push_back({static_cast<int8_t>(i), static_cast<int8_t>(-static_cast<int>(i))});
    }
    const VertexView view = make_vertex_view(stream(p), stream<ReadAs::integers>(bits), stream<ReadAs::integers>(more));
    Image<glm::vec4> image(kWidth, kWidth);
    Image<float> depth(kWidth, kWidth);
    Pass pass(kWidth, kWidth, rgba32f_target(image), d32f_target(depth));
    pass.draw(IntegerColorShader{}, view);
    pass.run(one_worker());
    NaiveTarget<float> naive(kWidth, kWidth, vec4<float>(0.0f), 1.0f);
    draw_naive(naive, IntegerColorShader{}, view, Indices::sequential(p.size()));
    EXPECT_EQ(std::memcmp(image.data(), naive.color.data(), kWidth * kWidth * sizeof(glm::vec4)), 0);
    NaiveTarget<double> exact(kWidth, kWidth, vec4<double>(0.0), 1.0);
    draw_naive(exact, IntegerColorShader{}, view, Indices::sequential(p.size()));
    int drawn = 0;
    for (int i = 0; i < kWidth * kWidth; ++i) {
      const vec4<double>& c = exact.color.data()[i];
      const glm::vec4& f = image.data()[i];
      if (f.w == 0.0f || c.w == 0.0) continue;
      ++drawn;
      EXPECT_EQ(static_cast<float>(c.x), f.x);
      EXPECT_EQ(static_cast<float>(c.y), f.y);
      EXPECT_EQ(static_cast<float>(c.z), f.z);
    }
    EXPECT_GT(drawn, 100);
  }
}

TEST(IntegerAttributes, ComponentsConvertBothWays) {
  using A = BitsShader::Attributes<double>;
  const A in{vec4<double>(1, 2, 3, 4), -5, {std::numeric_limits<int32_t>::min(), std::numeric_limits<int32_t>::max()}};
  const std::array<double, 7> numbers = to_components<double>(in);
  EXPECT_EQ(numbers, (std::array<double, 7>{1, 2, 3, 4, -5, -0x1p31, 0x1p31 - 1}));
  const A out = from_components<A, double>(numbers);
  EXPECT_EQ(out.bits, in.bits);
  EXPECT_EQ(out.more, in.more);
  EXPECT_EQ(out.position.w, 4.0);
}

// ---- arrays and many members -----------------------------------------------------------------------------------------

/// A matrix as an attribute, and an array of vectors as a varying.
struct MatrixAttributeShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    std::array<vec4<R>, 4> columns;
  };
  template <class R>
  struct Varyings {
    Flat<std::array<vec4<R>, 2>> colors;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const vec4<R>& p = in.position;
    out.colors.value = {in.columns[1], in.columns[3]};
    return in.columns[0] * p.x + in.columns[1] * p.y + in.columns[2] * p.z + in.columns[3] * p.w;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const MaskOf<R> left = px.x < R(8);
    const vec4<R>&a = in.colors.value[0], &b = in.colors.value[1];
    return {vec4<R>(select(left, a.x, b.x), select(left, a.y, b.y), select(left, a.z, b.z), select(left, a.w, b.w))};
  }
};

TEST(ArrayAttributes, AMatrixIsAnArrayOfItsColumns) {
  const std::vector<glm::vec4> p = full_screen();
  const std::vector<glm::mat4> matrices{glm::mat4(2, 0, 0, 0, 0.5f, 1, 0, 0, 0, 0, 1, 0, 0.25f, 0, 0, 1)};
  const auto image_of = [&](const auto& view) {
    Image<glm::vec4> image(16, 16);
    Pass pass(16, 16, rgba32f_target(image), {});
    pass.draw(MatrixAttributeShader{}, view);
    pass.run(one_worker());
    return image;
  };
  const Image<glm::vec4> image = image_of(make_vertex_view(stream(p), per_instance(stream(matrices))));
  EXPECT_EQ(pixel(image, 4, 1), matrices[0][1]);
  EXPECT_EQ(pixel(image, 12, 1), matrices[0][3]);
  const std::vector<glm::dmat4> doubles{glm::dmat4(matrices[0])};
  EXPECT_EQ(image, image_of(make_vertex_view(stream(p), per_instance(stream<ReadAs::floats>(doubles)))));
}

/// 16 attributes with 64 components, of which all are varyings.
struct FullShader {
  template <class R>
  struct Attributes {
    vec4<R> a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15;
  };
  template <class R>
  struct Varyings {
    vec4<R> a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14;
    Flat<vec4<R>> a15;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {in.a0, in.a1, in.a2, in.a3, in.a4, in.a5, in.a6, in.a7, in.a8, in.a9, in.a10, in.a11, in.a12, in.a13, in.a14, {in.a15}};
    return in.a0;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    const vec4<R> sum = in.a1 + in.a2 + in.a3 + in.a4 + in.a5 + in.a6 + in.a7 + in.a8 + in.a9 + in.a10 + in.a11 + in.a12 + in.a13;
    return {sum + in.a14 + in.a15.value};
  }
};
static_assert(kComponents<FullShader::Varyings<float>> == kMaxComponents);

TEST(ArrayAttributes, SixteenAttributesAnd64Varyings) {
  Random r(7);
  std::vector<FullShader::Attributes<float>> rows(30);
  for (auto& row : rows) {
    auto numbers = to_components<float>(row);
    for (float& x : numbers) x = r.real(-1.0f, 1.0f);
    numbers[3] = r.real(0.1f, 2.0f);
    row = from_components<FullShader::Attributes<float>, float>(numbers);
  }
  Image<glm::vec4> image(64, 64);
  Image<float> depth(64, 64);
  Pass pass(64, 64, rgba32f_target(image), d32f_target(depth));
  const auto view = make_vertex_view(stream(rows));
  EXPECT_EQ(view.components, 64);
  pass.draw(FullShader{}, view);
  EXPECT_GT(pass.run(one_worker()).samples_passed, 100u);
  NaiveTarget<float> naive(64, 64, vec4<float>(0.0f), 1.0f);
  draw_naive(naive, FullShader{}, view, Indices::sequential(rows.size()));
  EXPECT_EQ(std::memcmp(image.data(), naive.color.data(), 64 * 64 * sizeof(glm::vec4)), 0);
}

// ---- misuse ----------------------------------------------------------------------------------------------------------

class IntegerMisuseTest : public ThrowingChecksTest {};

TEST_F(IntegerMisuseTest, ViewsWithoutTypesAreChecked) {
  const std::vector<glm::vec4> p(3);
  const std::vector<int32_t> bits(3);
  const std::vector<float> numbers(3);
  const std::vector<glm::ivec2> more(3);
  Image<glm::vec4> image(8, 8);
  Pass pass(8, 8, rgba32f_target(image), {});
  const auto draw = [&](const VertexView& view) { return failure_of([&] { pass.draw(IntegerColorShader{}, view); }); };
  EXPECT_EQ(draw(make_vertex_view(stream(p), stream<ReadAs::integers>(bits), stream<ReadAs::integers>(more))), "");
  EXPECT_NE(draw(make_vertex_view(stream(p), stream(numbers), stream<ReadAs::integers>(more))).find("and stream<ReadAs::integers> for IntOf<R>"),
            std::string::npos);
  EXPECT_NE(draw(make_vertex_view(stream(p), stream<ReadAs::floats>(bits), stream<ReadAs::integers>(more))), "");
  EXPECT_NE(draw(make_vertex_view(stream<ReadAs::integers>(bits), stream(p), stream<ReadAs::integers>(more))), "") << "another order";
}

}  // namespace
}  // namespace halfspace::raster_test
