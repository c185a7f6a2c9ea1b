// SPDX-License-Identifier: Apache-2.0
//
// Blits: positions, scaling, flips, filters, limits, and conversion between formats.
#include "halfspace/raster/blit.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/texel_codec.h"
#include "raster/raster_test.h"
#include "support/throwing_checks.h"

namespace halfspace::raster_test::blits {
namespace {

// A picture whose texels are all different.
Image<glm::vec4> numbered(int width, int height) {
  Image<glm::vec4> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at(x, y) = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(x * y), 1.0f};
  }
  return image;
}
TexelView view_of(Image<glm::vec4>& image) { return texel_view(image, TexelFormat::rgba32f); }

constexpr glm::vec4 kUntouched(-1.0f, -2.0f, -3.0f, -4.0f);
Image<glm::vec4> untouched(int width, int height) {
  Image<glm::vec4> image(width, height);
  std::fill_n(image.data(), image.texels().size(), kUntouched);
  return image;
}

// Position in the source of the center of destination texel x, along one axis, by the formula of OpenGL. begin and size are those of the
// rectangles; a size can be negative.
double source_position(int x, int from_begin, int from_size, int to_begin, int to_size) {
  return from_begin + (x + 0.5 - to_begin) * from_size / to_size;
}
bool is_inside(int x, int begin, int size) { return x >= std::min(begin, begin + size) && x < std::max(begin, begin + size); }

Rect random_rect(Random& random, int size) {
  const auto extent = [&] { return random.between(1, size) * (random.once_in(2) ? 1 : -1); };
  return {random.between(-4, size + 4), random.between(-4, size + 4), extent(), extent()};
}

// Calls f(x, y, u, v) for each texel of the destination that is written: u and v are its position in the source.
template <class F>
void for_each_written(const Rect& from, int from_width, int from_height, const Rect& to, int to_width, int to_height, F f) {
  for (int y = 0; y < to_height; ++y) {
    for (int x = 0; x < to_width; ++x) {
      if (!is_inside(x, to.x, to.width) || !is_inside(y, to.y, to.height)) continue;
      const double u = source_position(x, from.x, from.width, to.x, to.width), v = source_position(y, from.y, from.height, to.y, to.height);
      if (u >= 0 && u < from_width && v >= 0 && v < from_height) f(x, y, u, v);
    }
  }
}

TEST(Blit, NearestFollowsTheFormulaOfOpenGl) {
  Random random(1);
  Image<glm::vec4> source = numbered(23, 17);
  for (int i = 0; i < effort(3000); ++i) {
    const Rect from = random_rect(random, 20), to = random_rect(random, 30);
    Image<glm::vec4> expected = untouched(31, 19), actual = untouched(31, 19);
    bool exact = true;  // no position is at an edge of a texel, where the double can be rounded to either side
    for_each_written(from, 23, 17, to, 31, 19, [&](int x, int y, double u, double v) {
      exact &= std::fabs(u - std::round(u)) > 1e-9 && std::fabs(v - std::round(v)) > 1e-9;
      expected.at(x, y) = source.at(static_cast<int>(u), static_cast<int>(v));
    });
    blit(view_of(source), from, view_of(actual), to);
    ASSERT_TRUE(!exact || expected == actual) << i;
  }
}

TEST(Blit, WholeFactorsFlipsAndLimits) {
  Image<glm::vec4> source = numbered(8, 6);
  const auto blitted = [&](const Rect& from, const Rect& to, BlitFilter filter) {
    Image<glm::vec4> image = untouched(16, 12);
    blit(view_of(source), from, view_of(image), to, filter);
    return image;
  };
  for (const BlitFilter filter : {BlitFilter::nearest, BlitFilter::linear}) {
    // A copy, which is mirrored by either rectangle and upright with both.
    for (const bool from_flip : {false, true}) {
      for (const bool to_flip : {false, true}) {
        const Rect from = from_flip ? Rect{8, 0, -8, 6} : Rect{0, 0, 8, 6}, to = to_flip ? Rect{11, 3, -8, 6} : Rect{3, 3, 8, 6};
        const Image<glm::vec4> image = blitted(from, to, filter);
        for (int y = 0; y < 12; ++y) {
          for (int x = 0; x < 16; ++x) {
            const bool inside = x >= 3 && x < 11 && y >= 3 && y < 9;
            const int u = from_flip != to_flip ? 10 - x : x - 3;
            EXPECT_EQ(image.at(x, y), inside ? source.at(u, y - 3) : kUntouched);
          }
        }
      }
    }
    // Only the part that exists on both sides is copied.
    const Image<glm::vec4> part = blitted({-2, -3, 20, 20}, {5, 4, 20, 20}, filter);
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 16; ++x) {
        const bool inside = x >= 7 && x < 15 && y >= 7;
        EXPECT_EQ(part.at(x, y), inside ? source.at(x - 7, y - 7) : kUntouched);
      }
    }
    EXPECT_EQ(blitted({0, 0, 0, 6}, {0, 0, 16, 12}, filter), untouched(16, 12));
    EXPECT_EQ(blitted({0, 0, 8, 6}, {0, 0, 16, 0}, filter), untouched(16, 12));
  }
  const Image<glm::vec4> twice = blitted({0, 6, 8, -6}, {0, 0, 16, 12}, BlitFilter::nearest);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 16; ++x) EXPECT_EQ(twice.at(x, y), source.at(x / 2, 5 - y / 2));
  }
}

TEST(Blit, LinearFiltersInsideTheSourceRectangle) {
  Random random(2);
  Image<glm::vec4> source(23, 17);
  for (int i = 0; i < 23 * 17; ++i) source.data()[i] = glm::vec4(random.real(0, 1), random.real(-5, 5), random.real(0, 1e6f), 1.0f);
  for (int i = 0; i < effort(300); ++i) {
    const Rect from = random_rect(random, 20), to = random_rect(random, 30);
    if (std::abs(from.width) == std::abs(to.width) && std::abs(from.height) == std::abs(to.height)) continue;
    Image<glm::vec4> seen = source;
    for (int y = 0; y < 17; ++y) {
      for (int x = 0; x < 23; ++x) {
        if (!is_inside(x, from.x, from.width) || !is_inside(y, from.y, from.height)) seen.at(x, y) = glm::vec4(1e30f);
      }
    }
    Image<glm::vec4> actual = untouched(31, 19);
    blit(view_of(seen), from, view_of(actual), to, BlitFilter::linear);
    const auto texel = [&](int x, int y) {
      const auto limited = [](int a, int begin, int size, int end) {
        return std::clamp(a, std::max(0, std::min(begin, begin + size)), std::min(end, std::max(begin, begin + size)) - 1);
      };
      return glm::dvec4(source.at(limited(x, from.x, from.width, 23), limited(y, from.y, from.height, 17)));
    };
    int written = 0, expected = 0;
    for (const glm::vec4& c : actual.texels()) written += c != kUntouched;
    for_each_written(from, 23, 17, to, 31, 19, [&](int x, int y, double u, double v) {
      ++expected;
      const double x0 = std::floor(u - 0.5), y0 = std::floor(v - 0.5), a = u - 0.5 - x0, b = v - 0.5 - y0;
      const int tx = static_cast<int>(x0), ty = static_cast<int>(y0);
      const glm::dvec4 value =
          (texel(tx, ty) * (1 - a) + texel(tx + 1, ty) * a) * (1 - b) + (texel(tx, ty + 1) * (1 - a) + texel(tx + 1, ty + 1) * a) * b;
      const glm::dvec4 error = glm::abs(glm::dvec4(actual.at(x, y)) - value);
      EXPECT_LE(error.x, 4e-7);
      EXPECT_LE(error.y, 2e-6);
      EXPECT_LE(error.z, 0.4);
      EXPECT_EQ(actual.at(x, y).w, 1.0f);
    });
    ASSERT_EQ(written, expected) << i;
  }
}

// With a factor of 1/2, all weights are 1/2.
TEST(Blit, HalvingIsTheMeanInLinearLight) {
  Image<glm::u8vec4> source(2, 2), half(1, 1);
  Random random(3);
  for (int i = 0; i < effort(2000); ++i) {
    std::array<glm::vec4, 4> colors;
    for (std::size_t k = 0; k < 4; ++k) {
      source.data()[k] = glm::u8vec4(random.below(256), random.below(256), random.below(256), random.below(256));
      colors[k] = decode_texel(TexelFormat::srgb8a8, reinterpret_cast<const std::byte*>(&source.data()[k]));
    }
    blit(texel_view(source, TexelFormat::srgb8a8), {0, 0, 2, 2}, texel_view(half, TexelFormat::srgb8a8), {0, 0, 1, 1}, BlitFilter::linear);
    const glm::vec4 mean = (colors[0] * 0.5f + colors[1] * 0.5f) * 0.5f + (colors[2] * 0.5f + colors[3] * 0.5f) * 0.5f;
    glm::u8vec4 expected;
    encode_texel(TexelFormat::srgb8a8, mean, reinterpret_cast<std::byte*>(&expected));
    EXPECT_EQ(half.at(0, 0), expected);
  }
}

TEST(Blit, CopiesTheBitsOfEveryFormat) {
  Random random(4);
  for (std::size_t f = 1; f < kTexelFormats; ++f) {
    const auto format = static_cast<TexelFormat>(f);
    const int bytes = texel_info(format).bytes;
    std::vector<std::byte> source(static_cast<std::size_t>(2 * 11 * 9 * bytes)), copy(source.size());
    for (std::byte& b : source) b = static_cast<std::byte>(random.below(256));
    const auto view = [&](std::vector<std::byte>& memory) { return TexelView{format, memory.data(), 11, 9, 2, 11 * bytes, 99 * bytes}; };
    blit(view(source), {0, 0, 11, 9}, view(copy), {0, 0, 11, 9});
    EXPECT_EQ(source, copy) << texel_info(format).name;
    std::ranges::fill(copy, std::byte{});
    blit(view(source), {11, 9, -11, -9}, view(copy), {0, 0, 11, 9}, BlitFilter::nearest, &two_workers());
    for (int i = 0; i < 198; ++i) {
      const int from = i / 99 * 99 + 98 - i % 99;
      EXPECT_EQ(std::memcmp(&source[static_cast<std::size_t>(from * bytes)], &copy[static_cast<std::size_t>(i * bytes)],
                            static_cast<std::size_t>(bytes)),
                0)
          << texel_info(format).name;
    }
  }
}

TEST(Blit, ConvertsColorsAndIntegers) {
  Random random(5);
  Image<glm::vec4> colors(7, 5);
  for (int i = 0; i < 35; ++i)
    colors.data()[i] = glm::vec4(random.real(-0.2f, 1.2f), random.real(-1, 1), random.real(0, 4), random.real(0, 1));
  for (std::size_t f = 1; f < kTexelFormats; ++f) {
    const auto format = static_cast<TexelFormat>(f);
    const int bytes = texel_info(format).bytes;
    if (is_depth(format)) continue;
    std::vector<std::byte> memory(static_cast<std::size_t>(35 * bytes)), expected(memory.size());
    const TexelView to{format, memory.data(), 7, 5, 1, 7 * bytes, 35 * bytes};
    if (is_integer(format)) {
      const TexelFormat wide = texel_info(format).kind == TexelKind::sints ? TexelFormat::rgba32i : TexelFormat::rgba32ui;
      Image<glm::ivec4> integers(7, 5);
      for (int i = 0; i < 35; ++i) {
        for (int k = 0; k < 4; ++k) integers.data()[i][k] = static_cast<int32_t>(random.bits()) >> random.below(32);
        encode_integers(format, integers.data()[i], &expected[static_cast<std::size_t>(i * bytes)]);
      }
      blit(texel_view(integers, wide), {0, 0, 7, 5}, to, {0, 0, 7, 5});
    } else {
      for (int i = 0; i < 35; ++i) encode_texel(format, colors.data()[i], &expected[static_cast<std::size_t>(i * bytes)]);
      blit(view_of(colors), {0, 0, 7, 5}, to, {0, 0, 7, 5});
    }
    EXPECT_EQ(memory, expected) << texel_info(format).name;
  }
}

TEST(Blit, ThreadsDoNotChangeTheResult) {
  Image<glm::vec4> source = numbered(100, 90), one(157, 201), many(157, 201);
  for (const BlitFilter filter : {BlitFilter::nearest, BlitFilter::linear}) {
    blit(view_of(source), {3, 90, 90, -80}, view_of(one), {0, 0, 157, 201}, filter);
    blit(view_of(source), {3, 90, 90, -80}, view_of(many), {0, 0, 157, 201}, filter, &two_workers());
    EXPECT_EQ(one, many);
  }
}

class BlitMisuse : public ThrowingChecksTest {};

TEST_F(BlitMisuse, IsRefusedInOneLine) {
  std::vector<std::byte> a(16 * 64), b(16 * 64);
  const auto view = [](std::vector<std::byte>& memory, TexelFormat format, int layers = 1) {
    const int bytes = texel_info(format).bytes;
    return TexelView{format, memory.data(), 4, 4, layers, 4 * bytes, 16 * bytes};
  };
  const auto message = [&](TexelFormat from, TexelFormat to, BlitFilter filter = BlitFilter::nearest, int layers = 1) {
    return failure_of([&] { blit(view(a, from), {0, 0, 4, 4}, view(b, to, layers), {0, 0, 4, 2}, filter); });
  };
  using enum TexelFormat;
  EXPECT_EQ(message(rgba8, r32f, BlitFilter::linear), "");
  EXPECT_EQ(message(r8ui, rgba16ui), "");
  for (const auto& [from, to] : {std::pair(r32ui, r32i), {r32i, r32ui}, {r32ui, r32f}, {r32f, r32ui}, {rgba8ui, rgba8}, {r8i, r8ui}})
    EXPECT_NE(message(from, to).find("integers are copied to a format of another type"), std::string::npos);
  for (const auto& [from, to] : {std::pair(d32f, r32f), {r32f, d32f}, {d24, d24s8}, {d16, d32f}})
    EXPECT_NE(message(from, to).find("depth is copied to another format"), std::string::npos);
  for (const TexelFormat f : {r32ui, rgba8i, d32f, d24s8}) {
    EXPECT_EQ(message(f, f), "");
    EXPECT_NE(message(f, f, BlitFilter::linear).find("integers or depth are filtered"), std::string::npos);
  }
  EXPECT_NE(message(none, rgba8).find("has no format"), std::string::npos);
  EXPECT_NE(message(rgba8, rgba8, BlitFilter::nearest, 2).find("different numbers of layers"), std::string::npos);
  const auto inside = [&](const Rect& from, const Rect& to) { return failure_of([&] { blit(view(a, rgba8), from, view(a, rgba8), to); }); };
  EXPECT_EQ(inside({0, 0, 2, 2}, {2, 2, 2, 2}), "");
  EXPECT_EQ(inside({0, 0, 2, 4}, {2, 0, 2, 4}), "");
  EXPECT_NE(inside({0, 0, 2, 2}, {3, 3, -2, -2}).find("the rectangles share memory"), std::string::npos);
  EXPECT_NE(inside({0, 0, 1 << 21, 1}, {0, 0, 1, 1}).find("too large"), std::string::npos);
}

TEST_F(BlitMisuse, ResolvesOfOtherViewsAreRefused) {
  std::vector<std::byte> a(16 * 64), b(16 * 64);
  const auto message = [&](TexelFormat from, int layers, TexelFormat to, int width, ResolveMode mode) {
    const int bytes = texel_info(from).bytes, to_bytes = texel_info(to).bytes;
    return failure_of([&] {
      resolve(TexelView{from, a.data(), 4, 2, layers, 4 * bytes, 8 * bytes}, TexelView{to, b.data(), width, 2, 1, width * to_bytes, 0},
              mode);
    });
  };
  using enum TexelFormat;
  EXPECT_EQ(message(rgba8, 4, rgba16f, 4, ResolveMode::mean), "");
  EXPECT_EQ(message(r32ui, 4, r8ui, 4, ResolveMode::sample_0), "");
  EXPECT_EQ(message(d24, 4, d24, 4, ResolveMode::max), "");
  EXPECT_NE(message(rgba8, 4, rgba8, 3, ResolveMode::mean).find("do not match"), std::string::npos);
  EXPECT_NE(message(rgba8, 3, rgba8, 4, ResolveMode::mean).find("number of layers"), std::string::npos);
  EXPECT_NE(message(r32ui, 4, r32ui, 4, ResolveMode::mean).find("have no mean"), std::string::npos);
  EXPECT_NE(message(d32f, 4, d32f, 4, ResolveMode::mean).find("have no mean"), std::string::npos);
  EXPECT_NE(message(r32f, 4, r32f, 4, ResolveMode::min).find("apply to depth"), std::string::npos);
  EXPECT_NE(message(d32f, 4, d16, 4, ResolveMode::max).find("another format"), std::string::npos);
}

}  // namespace
}  // namespace halfspace::raster_test::blits
