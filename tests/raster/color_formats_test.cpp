// SPDX-License-Identifier: Apache-2.0
//
// Every color format as an attachment: the bytes of the image are those of the codec for the colors that were drawn.
#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <vector>

#include "halfspace/core/texel_codec.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test::color_formats {
namespace {

constexpr int kWidth = 70, kHeight = 21;  // tiles at the right and upper border are partial

template <class F>
void for_each_color_format(const F& f) {
  for (std::size_t i = 1; i < kTexelFormats; ++i) {
    const auto format = static_cast<ColorFormat>(i);
    if (!is_depth(format) && format != ColorFormat::rgb9_e5) f(format);
  }
}

std::size_t bytes_of(ColorFormat format) { return static_cast<std::size_t>(bytes_per_pixel(format)); }

struct Bytes {
  explicit Bytes(ColorFormat f) : format(f), bytes(static_cast<std::size_t>(kWidth * kHeight) * bytes_of(f)) {}
  ColorTarget target(LoadOp load = LoadOp::clear, glm::vec4 clear = glm::vec4(0.0f)) {
    return {.format = format, .data = bytes.data(), .width = kWidth, .height = kHeight, .load = load, .clear_value = clear};
  }
  const std::byte* texel(int x, int y) const { return &bytes[static_cast<std::size_t>((kHeight - 1 - y) * kWidth + x) * bytes_of(format)]; }
  ColorFormat format;
  std::vector<std::byte> bytes;
};

using Texel = std::array<std::byte, 16>;
Texel encoded(ColorFormat format, const glm::vec4& color) {
  Texel texel{};
  if (is_integer(format)) {
    encode_integers(format, std::bit_cast<glm::ivec4>(color), texel.data());
  } else {
    encode_texel(format, color, texel.data());
  }
  return texel;
}
// Returns how many pixels differ from the encoded colors color_at(x, y).
template <class F>
int differences(const Bytes& image, const F& color_at) {
  int count = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Texel expected = encoded(image.format, color_at(x, y));
      count += std::memcmp(image.texel(x, y), expected.data(), bytes_of(image.format)) != 0;
    }
  }
  return count;
}

// Colors from −1.3 to 1.9 that depend on the pixel.
template <class R>
vec4<R> color_at(R x, R y) {
  return {x * R(0.0457f) - R(1.3f), y * R(0.15f) - R(1.3f), (x + y) * R(0.011f), y * R(0.06f) - R(0.1f)};
}
template <class R>
ivec4<R> integers_at(R x, R y) {
  const IntOf<R> i = truncate_to_int(x), j = truncate_to_int(y);
  return {i * 7 - 200, i * 1000 - j * 3000, j - 10, (i + j) << 20};
}
struct PlaceShader : PositionShader {
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {color_at<R>(px.x, px.y)};
  }
};
template <template <class> class Integers>
struct IntegerPlaceShader : PositionShader {
  template <class R>
  TypedFragment<R, Integers<R>> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {Integers<R>(integers_at<R>(px.x, px.y))};
  }
};
glm::vec4 drawn_at(int x, int y, ColorFormat format) {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  const vec4<float> c = color_at<float>(px, py);
  const ivec4<float> i = integers_at<float>(px, py);
  return is_integer(format) ? std::bit_cast<glm::vec4>(glm::ivec4(i.x, i.y, i.z, i.w)) : glm::vec4(c.x, c.y, c.z, c.w);
}

const std::vector<glm::vec4>& everywhere() {
  static const std::vector<glm::vec4> positions = full_screen();
  return positions;
}

// Draws the colors of the pixels, with the type of the format.
void draw_places(Pass& pass, ColorFormat format, const DrawState& state = {}) {
  const VertexView vertices = make_vertex_view(stream(everywhere()));
  const TexelKind kind = texel_info(format).kind;
  if (kind == TexelKind::sints) return pass.draw(IntegerPlaceShader<ivec4>{}, vertices, state);
  if (kind == TexelKind::uints) return pass.draw(IntegerPlaceShader<uvec4>{}, vertices, state);
  pass.draw(PlaceShader{}, vertices, state);
}

TEST(ColorFormats, StoreTheNearestTexel) {
  for_each_color_format([](ColorFormat format) {
    for (const int samples : {1, 4}) {
      Bytes image(format);
      Pass pass(kWidth, kHeight, image.target(), {}, {.samples = samples});
      draw_places(pass, format);
      pass.run(one_worker());
      EXPECT_EQ(differences(image, [&](int x, int y) { return drawn_at(x, y, format); }), 0) << texel_info(format).name << ' ' << samples;
    }
  });
}

// With and without a tile.
TEST(ColorFormats, ClearToTheNearestTexel) {
  for_each_color_format([](ColorFormat format) {
    const glm::vec4 clear =
        is_integer(format) ? std::bit_cast<glm::vec4>(glm::ivec4(70000, -5, 200, -200)) : glm::vec4(0.3f, -0.7f, 1.2f, 0.6f);
    for (const bool draws : {false, true}) {
      Bytes image(format);
      Pass pass(kWidth, kHeight, image.target(LoadOp::clear, clear), {});
      if (draws) draw_places(pass, format, {.scissor = Rect{0, 0, 10, kHeight}});
      pass.run(one_worker());
      const auto expected = [&](int x, int y) { return draws && x < 10 ? drawn_at(x, y, format) : clear; };
      EXPECT_EQ(differences(image, expected), 0) << texel_info(format).name << ' ' << draws;
    }
  });
}

// Also with several rounds, between which the colors are in the image or, with several samples, in a spill buffer.
TEST(ColorFormats, LoadWhatTheyHaveStored) {
  for_each_color_format([](ColorFormat format) {
    for (const int samples : {1, 2}) {
      Bytes image(format);
      Pass first(kWidth, kHeight, image.target(), {});
      draw_places(first, format);
      first.run(one_worker());
      const std::vector<std::byte> before = image.bytes;
      Pass second(kWidth, kHeight, image.target(LoadOp::load), {}, {.samples = samples, .tuning = {.chunk_triangles = 1, .bin_budget = 1}});
      for (int i = 0; i < 100; ++i) draw_places(second, format, {.scissor = Rect{i % kWidth, i % kHeight, 1, 1}});
      const PassStatistics statistics = second.run(one_worker());
      EXPECT_GT(statistics.flushes, 0);
      EXPECT_EQ(image.bytes, before) << texel_info(format).name << ' ' << samples;
    }
  });
}

// Each sum is rounded to a texel. Normalized source colors are clamped first.
TEST(ColorFormats, AddToTheExistingTexel) {
  for_each_color_format([](ColorFormat format) {
    if (is_integer(format)) return;
    const glm::vec4 before(0.25f, -0.5f, 0.125f, 0.75f);
    Bytes image(format);
    Pass pass(kWidth, kHeight, image.target(LoadOp::clear, before), {});
    for (int i = 0; i < 2; ++i) draw_places(pass, format, {.blend = kAdd});
    pass.run(one_worker());
    const TexelKind kind = texel_info(format).kind;
    const bool is_normalized = kind == TexelKind::unorm || kind == TexelKind::srgb || kind == TexelKind::snorm;
    const float low = kind == TexelKind::snorm ? -1.0f : 0.0f;
    const auto sum = [&](int x, int y) {
      const glm::vec4 drawn = drawn_at(x, y, format);
      const glm::vec4 source = is_normalized ? glm::clamp(drawn, glm::vec4(low), glm::vec4(1.0f)) : drawn;
      const auto stored = [&](const glm::vec4& color) { return decode_texel(format, encoded(format, color).data()); };
      return stored(stored(before) + source) + source;
    };
    EXPECT_EQ(differences(image, sum), 0) << texel_info(format).name;
  });
}

// What is loaded and stored keeps its infinities.
TEST(ColorFormats, InfinitiesThatNobodyDrewAreKept) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const ColorFormat format : {ColorFormat::r16f, ColorFormat::rgba16f, ColorFormat::r11f_g11f_b10f, ColorFormat::r32f}) {
    Bytes image(format);
    for (std::size_t i = 0; i < image.bytes.size(); i += bytes_of(format)) {
      const Texel infinite = encoded(format, glm::vec4(kInfinity));
      std::copy_n(infinite.begin(), bytes_of(format), &image.bytes[i]);
    }
    const std::vector<std::byte> before = image.bytes;
    Pass pass(kWidth, kHeight, image.target(LoadOp::load), {});
    draw_places(pass, format, {.scissor = Rect{0, 0, 1, 1}});
    pass.run(one_worker());
    std::copy_n(before.begin(), bytes_of(format), const_cast<std::byte*>(image.texel(0, 0)));
    EXPECT_EQ(image.bytes, before) << texel_info(format).name;
  }
}

// 1 − (−1) is clamped to 1 (OpenGL 4.6, section 17.3.6): 0.5 · 1 is the code 63.5, which is rounded to even.
TEST(ColorFormats, FactorsOfSignedNormalizedFormatsAreClamped) {
  Bytes image(ColorFormat::rgba8_snorm);
  Pass pass(kWidth, kHeight, image.target(LoadOp::clear, glm::vec4(-1.0f)), {});
  const BlendState blend{BlendEquation::add, BlendFactor::one_minus_dst_color, BlendFactor::zero,
                         BlendEquation::add, BlendFactor::one_minus_dst_color, BlendFactor::zero};
  pass.draw(ConstantShader{glm::vec4(0.5f)}, make_vertex_view(stream(everywhere())), {.blend = blend});
  pass.run(one_worker());
  EXPECT_TRUE(std::ranges::all_of(image.bytes, [](std::byte b) { return b == std::byte{64}; }));
}

TEST(ColorFormats, MasksKeepOtherChannels) {
  for_each_color_format([](ColorFormat format) {
    const glm::vec4 before = is_integer(format) ? std::bit_cast<glm::vec4>(glm::ivec4(3, 4, 5, 1)) : glm::vec4(0.25f, 0.5f, 0.125f, 0.75f);
    Bytes image(format);
    Pass pass(kWidth, kHeight, image.target(LoadOp::clear, before), {});
    draw_places(pass, format, {.color_mask = {true, false, true, false}});
    pass.run(one_worker());
    EXPECT_EQ(differences(image,
                          [&](int x, int y) {
                            const glm::vec4 source = drawn_at(x, y, format);
                            return glm::vec4(source.x, before.y, source.z, before.w);
                          }),
              0)
        << texel_info(format).name;
  });
}

TEST(ColorFormats, ImagesOfAnyPixelsAreTargets) {
  Image<glm::u8vec2> image(kWidth, kHeight);
  Pass pass(kWidth, kHeight, color_target(ColorFormat::rg8, image), {});
  pass.draw(ConstantShader{{1.0f, 0.4f, 0.0f, 0.0f}}, make_vertex_view(stream(everywhere())));
  pass.run(one_worker());
  EXPECT_TRUE(std::ranges::all_of(image.texels(), [](const glm::u8vec2& t) { return t == glm::u8vec2(255, 102); }));
  EXPECT_DEATH(color_target(ColorFormat::rg16, image), "another size than the format");
}

TEST(ColorFormatsDeathTest, ColorsOfAnotherTypeAreRefused) {
  const auto expect_refused = [](ColorFormat format, const auto& shader) {
    Bytes image(format);
    Pass pass(kWidth, kHeight, image.target(), {});
    EXPECT_DEATH(pass.draw(shader, make_vertex_view(stream(everywhere()))), "another type than its attachment") << texel_info(format).name;
  };
  expect_refused(ColorFormat::r32ui, PlaceShader{});
  expect_refused(ColorFormat::rgba8i, PlaceShader{});
  expect_refused(ColorFormat::rgba8i, IntegerPlaceShader<uvec4>{});
  expect_refused(ColorFormat::r16ui, IntegerPlaceShader<ivec4>{});
  expect_refused(ColorFormat::rgba8, IntegerPlaceShader<uvec4>{});
  expect_refused(ColorFormat::r32f, IntegerPlaceShader<ivec4>{});
}

TEST(ColorFormatsDeathTest, FormatsThatCannotBeDrawnToAreRefused) {
  Bytes image(ColorFormat::rgb9_e5), depth(ColorFormat::d32f);
  EXPECT_DEATH(Pass(kWidth, kHeight, image.target(), {}), "cannot be drawn to");
  EXPECT_DEATH(Pass(kWidth, kHeight, depth.target(), {}), "cannot be drawn to");
  EXPECT_DEATH(Pass(kWidth, kHeight, ColorTarget{}, {.format = DepthFormat::rgba8}), "has no depth");
}

}  // namespace
}  // namespace halfspace::raster_test::color_formats
