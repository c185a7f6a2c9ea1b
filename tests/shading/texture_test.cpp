// SPDX-License-Identifier: Apache-2.0
//
// Tests Texture2D against hand-computed values, the invariants that its header documents, and an independent reference in double. Results
// must be bit-identical at every width.
#include "halfspace/shading/texture/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/constants.h"

namespace halfspace {
namespace {

constexpr Sampler kBilinear{Filter::bilinear, Filter::bilinear, Wrap::repeat, Wrap::repeat};
constexpr Sampler kBilinearClamp{Filter::bilinear, Filter::bilinear, Wrap::clamp, Wrap::clamp};
constexpr Sampler kNearest{Filter::nearest, Filter::nearest, Wrap::repeat, Wrap::repeat};
constexpr Sampler kNearestClamp{Filter::nearest, Filter::nearest, Wrap::clamp, Wrap::clamp};

Image<glm::u8vec4> noise(int width, int height, unsigned seed) {
  Image<glm::u8vec4> image(width, height);
  std::mt19937 random(seed);
  for (int i = 0; i < width * height; ++i) {
    const auto bits = static_cast<uint32_t>(random());
    image.data()[i] = glm::u8vec4(bits & 255, (bits >> 8) & 255, (bits >> 16) & 255, bits >> 24);
  }
  return image;
}

Image<glm::u8vec4> constant(int width, int height, glm::u8vec4 value) {
  Image<glm::u8vec4> image(width, height);
  std::fill_n(image.data(), width * height, value);
  return image;
}

template <class R>
vec4<R> at(const Texture2D& texture, const Sampler& sampler, R s, R t, R lod = R(0.0f)) {
  return texture.sample_level(sampler, vec2<R>(s, t), lod);
}

/// Returns the linear value of a texel.
glm::dvec4 value(const Texture2D& texture, int level, int x, int row) {
  const glm::u8vec4 t = texture.texel(level, x, row);
  const auto channel = [&](uint8_t code) {
    return texture.format() == TexelFormat::srgb8a8 ? static_cast<double>(kSrgbToLinear[code]) : code / 255.0;
  };
  return {channel(t.x), channel(t.y), channel(t.z), t.w / 255.0};
}

// ---- independent reference in double, following OpenGL 4.6, section 8.14.2 -------------------------------------------

int wrapped_index(int64_t i, int size, Wrap wrap) {
  if (wrap == Wrap::clamp) return static_cast<int>(std::clamp<int64_t>(i, 0, size - 1));
  return static_cast<int>(((i % size) + size) % size);
}
glm::dvec4 reference_level(const Texture2D& texture, const Sampler& sampler, double s, double t, int level, Filter filter) {
  const int w = texture.width(level), h = texture.height(level);
  const auto texel = [&](double x, double y) {
    return value(texture, level, wrapped_index(static_cast<int64_t>(x), w, sampler.wrap_s),
                 wrapped_index(static_cast<int64_t>(y), h, sampler.wrap_t));
  };
  if (filter == Filter::nearest) return texel(std::floor(s * w), std::floor(t * h));
  const double u = s * w - 0.5, v = t * h - 0.5, x = std::floor(u), y = std::floor(v);
  const double a = u - x, b = v - y;
  return (1 - a) * (1 - b) * texel(x, y) + a * (1 - b) * texel(x + 1, y) + (1 - a) * b * texel(x, y + 1) + a * b * texel(x + 1, y + 1);
}
glm::dvec4 reference(const Texture2D& texture, const Sampler& sampler, double s, double t, double lod) {
  if (!(lod > 0)) return reference_level(texture, sampler, s, t, 0, sampler.mag);
  if (sampler.min != Filter::trilinear) return reference_level(texture, sampler, s, t, 0, sampler.min);
  const double clamped = std::min(lod, texture.levels() - 1.0), level = std::floor(clamped);
  const int below = static_cast<int>(level), above = std::min(below + 1, texture.levels() - 1);
  const double f = clamped - level;
  return (1 - f) * reference_level(texture, sampler, s, t, below, Filter::bilinear) +
         f * reference_level(texture, sampler, s, t, above, Filter::bilinear);
}

// ---- construction and levels ----------------------------------------------------------------------------------------

TEST(Texture, KeepsItsTexelsAndHasAllLevels) {
  const Image<glm::u8vec4> image = noise(13, 6, 1);
  const Texture2D texture(image, TexelFormat::rgba8);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 13; ++x) EXPECT_EQ(texture.texel(0, x, y), image.at(x, y));
  }
  const int widths[] = {13, 6, 3, 1}, heights[] = {6, 3, 1, 1};
  ASSERT_EQ(texture.levels(), 4);
  for (int l = 0; l < 4; ++l) {
    EXPECT_EQ(texture.width(l), widths[l]);
    EXPECT_EQ(texture.height(l), heights[l]);
  }
  EXPECT_EQ(Texture2D(constant(1, 1, {1, 2, 3, 4}), TexelFormat::rgba8).levels(), 1);
}

TEST(TextureDeathTest, RejectsLevelsThatAreNotHalved) {
  const Image<glm::u8vec4> levels[] = {noise(8, 8, 1), noise(4, 3, 1)};
  EXPECT_DEATH(Texture2D(levels, TexelFormat::rgba8), "wrong height");
  EXPECT_DEATH(Texture2D(Image<glm::u8vec4>(), TexelFormat::rgba8), "width");
}

TEST(Texture, UsesExplicitlyGivenLevels) {
  const Image<glm::u8vec4> levels[] = {constant(4, 4, {0, 0, 0, 0}), constant(2, 2, {255, 255, 255, 255})};
  const Texture2D texture(levels, TexelFormat::rgba8);
  ASSERT_EQ(texture.levels(), 2);
  EXPECT_EQ(at(texture, Sampler(), 0.3f, 0.3f, 0.25f).x, 0.25f);  // a quarter of the way from level 0 to level 1
  EXPECT_EQ(at(texture, Sampler(), 0.3f, 0.3f, 9.0f).x, 1.0f);    // clamped to the last level
}

TEST(Texture, MipsOfAConstantAreConstant) {
  for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::srgb8a8}) {
    for (int code = 0; code < 256; ++code) {
      const glm::u8vec4 c(code, 255 - code, code ^ 85, code);
      for (const Image<glm::u8vec4>& level : mip_chain(constant(31, 9, c), format)) {
        for (const glm::u8vec4& t : level.texels()) ASSERT_EQ(t, c);
      }
    }
  }
}

TEST(Texture, MipOfEvenSizeIsTheMeanOfFourTexels) {
  Image<glm::u8vec4> image(2, 2);
  image.at(0, 0) = {0, 0, 10, 0};
  image.at(1, 0) = {255, 1, 20, 0};
  image.at(0, 1) = {0, 2, 30, 1};
  image.at(1, 1) = {255, 4, 41, 0};
  EXPECT_EQ(mip_chain(image, TexelFormat::rgba8)[0].at(0, 0), glm::u8vec4(128, 2, 25, 0));  // 127.5 rounds to even; then 1.75, 25.25, 0.25
  // In sRGB, half the light of white encodes to 188. Alpha is always linear.
  EXPECT_EQ(mip_chain(image, TexelFormat::srgb8a8)[0].at(0, 0).x, 188);
  EXPECT_EQ(mip_chain(image, TexelFormat::srgb8a8)[0].at(0, 0).w, 0);
}

// Rows are converted several texels at a time, and their ends one by one.
TEST(Texture, MipRowsOfAnyLengthAreMeansOfFourTexels) {
  for (int width = 1; width <= 21; ++width) {
    const Image<glm::u8vec4> image = noise(2 * width, 2, static_cast<unsigned>(width));
    const Image<glm::u8vec4> codes = mip_chain(image, TexelFormat::rgba8)[0], colors = mip_chain(image, TexelFormat::srgb8a8)[0];
    for (int x = 0; x < width; ++x) {
      for (glm::length_t c = 0; c < 4; ++c) {
        const auto mean = [&](const auto& number) {
          const auto column = [&](int i) { return number(image.at(i, 0)[c]) + number(image.at(i, 1)[c]); };
          return 0.25f * (column(2 * x) + column(2 * x + 1));
        };
        const int code = round_to_int(mean([](uint8_t t) { return static_cast<float>(t); }));
        EXPECT_EQ(codes.at(x, 0)[c], code) << width;
        EXPECT_EQ(colors.at(x, 0)[c], c == 3 ? code : linear_to_srgb(mean([](uint8_t t) { return kSrgbToLinear[t]; }))) << width;
      }
    }
  }
}

TEST(Texture, MipOfOddSizeWeightsByArea) {
  Image<glm::u8vec4> image(5, 1);
  for (int x = 0; x < 5; ++x) image.at(x, 0) = glm::u8vec4(x == 0 ? 250 : 0, x == 1 ? 250 : 0, x == 2 ? 250 : 0, 0);
  const Image<glm::u8vec4> level = mip_chain(image, TexelFormat::rgba8)[0];
  ASSERT_EQ(level.width(), 2);
  EXPECT_EQ(level.at(0, 0), glm::u8vec4(100, 100, 50, 0));  // weights 2/5, 2/5, 1/5
  EXPECT_EQ(level.at(1, 0), glm::u8vec4(0, 0, 50, 0));      // weights 1/5, 2/5, 2/5; both texels share the middle one
}

TEST(Texture, MipsPreserveTheMean) {
  for (const glm::ivec2 size : {glm::ivec2(31, 17), glm::ivec2(64, 64), glm::ivec2(15, 8), glm::ivec2(1, 129)}) {
    const Image<glm::u8vec4> image = noise(size.x, size.y, 3);
    const auto mean = [](const Image<glm::u8vec4>& i) {
      glm::dvec4 sum(0.0);
      for (const glm::u8vec4& t : i.texels()) sum += glm::dvec4(t);
      return sum / static_cast<double>(i.texels().size());
    };
    for (const Image<glm::u8vec4>& level : mip_chain(image, TexelFormat::rgba8)) {
      const glm::dvec4 difference = glm::abs(mean(level) - mean(image));
      // The filter preserves the mean, but every 8-bit value is rounded by up to 1/2. For n independent texels, the mean of these errors
      // has a standard deviation of 0.29/sqrt(n). The bound is 5 standard deviations, or 0.5 for few texels.
      const double bound = std::min(0.5, 5 * 0.29 / std::sqrt(static_cast<double>(level.texels().size()))) + 1e-4;
      for (int c = 0; c < 4; ++c) EXPECT_LE(difference[c], bound) << level.width() << " x " << level.height();
    }
  }
}

// ---- filtering ------------------------------------------------------------------------------------------------------

TEST(Texture, ConstantsStayExact) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> any(-3.0f, 3.0f);
  for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::srgb8a8}) {
    for (int code = 0; code < 256; code += 5) {
      const Texture2D texture(constant(7, 5, {code, 255 - code, code / 2, code}), format);
      const glm::dvec4 exact = value(texture, 0, 0, 0);
      const glm::vec4 want(exact);
      for (int i = 0; i < 200; ++i) EXPECT_EQ(at(texture, Sampler(), any(random), any(random), any(random)), want);
    }
  }
}

TEST(Texture, TexelCentersReturnTheTexel) {
  // For sizes that are not powers of two, (i + 1/2)/size has a rounding error of up to 2^-25. After multiplication by the size, the error
  // is up to 200·2^-25 < 2^-16 texels. Rounding the fraction to 2^-15 removes it.
  for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::srgb8a8}) {
    for (const glm::ivec2 size : {glm::ivec2(8, 4), glm::ivec2(7, 5), glm::ivec2(200, 3), glm::ivec2(1, 1), glm::ivec2(64, 1)}) {
      const Texture2D texture(noise(size.x, size.y, 5), format);
      for (const Sampler& sampler : {kBilinear, kBilinearClamp, kNearest, kNearestClamp, Sampler()}) {
        for (int y = 0; y < size.y; ++y) {
          for (int x = 0; x < size.x; ++x) {
            const float s = (static_cast<float>(x) + 0.5f) / static_cast<float>(size.x),
                        t = (static_cast<float>(y) + 0.5f) / static_cast<float>(size.y);
            ASSERT_EQ(at(texture, sampler, s, t), glm::vec4(value(texture, 0, x, y))) << x << ' ' << y;
          }
        }
      }
    }
  }
}

TEST(Texture, HalfwayBetweenTexelsIsTheirMean) {
  Image<glm::u8vec4> image(2, 1);
  image.at(0, 0) = {10, 0, 0, 255};
  image.at(1, 0) = {20, 255, 1, 255};
  const Texture2D texture(image, TexelFormat::rgba8);
  EXPECT_EQ(at(texture, kBilinear, 0.5f, 0.5f), glm::vec4(15.0f / 255.0f, 0.5f, 0.5f / 255.0f, 1.0f));
  EXPECT_EQ(at(texture, kBilinear, 0.0f, 0.5f).x, 15.0f / 255.0f);       // across the seam
  EXPECT_EQ(at(texture, kBilinearClamp, 0.0f, 0.5f).x, 10.0f / 255.0f);  // no seam when clamping
}

TEST(Texture, RowZeroIsAtTZero) {
  Image<glm::u8vec4> image(1, 4);
  for (int y = 0; y < 4; ++y) image.at(0, y) = glm::u8vec4(50 * y, 0, 0, 0);
  const Texture2D texture(image, TexelFormat::rgba8);
  EXPECT_EQ(at(texture, kNearestClamp, 0.5f, 0.1f).x, 0.0f);
  EXPECT_EQ(at(texture, kNearestClamp, 0.5f, 0.9f).x, 150.0f / 255.0f);
}

TEST(Texture, ResultsStayWithinTheRangeOfTheirTexels) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> any(-0.2f, 1.2f);
  for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::srgb8a8}) {
    const Texture2D texture(noise(5, 5, 7), format);
    for (int i = 0; i < 200000; ++i) {
      const float s = any(random), t = any(random);
      const int x = static_cast<int>(std::floor(s * 5.0f - 0.5f)), y = static_cast<int>(std::floor(t * 5.0f - 0.5f));
      const float near_edge = std::max(std::fabs(s * 5.0f - 0.5f - std::round(s * 5.0f - 0.5f)), 0.0f);
      const float near_row = std::fabs(t * 5.0f - 0.5f - std::round(t * 5.0f - 0.5f));
      if (std::min(near_edge, near_row) < 1e-4f) continue;  // the test cannot tell which cell applies
      glm::vec4 low(1.0f), high(0.0f);
      for (int k = 0; k < 4; ++k) {
        const glm::vec4 v(value(texture, 0, wrapped_index(x + k % 2, 5, Wrap::clamp), wrapped_index(y + k / 2, 5, Wrap::clamp)));
        low = glm::min(low, v);
        high = glm::max(high, v);
      }
      const glm::vec4 got = at(texture, kBilinearClamp, s, t);
      for (int c = 0; c < 4; ++c) {
        ASSERT_GE(got[c], low[c]) << s << ' ' << t;
        ASSERT_LE(got[c], high[c]) << s << ' ' << t;
      }
    }
  }
}

TEST(Texture, BilinearIsMonotonic) {
  // The right column is brighter than the left one in both rows, so the result must never decrease from left to right.
  std::mt19937 random(8);
  for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::srgb8a8}) {
    for (int trial = 0; trial < 40; ++trial) {
      Image<glm::u8vec4> image(2, 2);
      for (int y = 0; y < 2; ++y) {
        const int a = static_cast<int>(random() % 256), b = a + static_cast<int>(random() % static_cast<unsigned>(256 - a));
        image.at(0, y) = glm::u8vec4(static_cast<uint8_t>(a));
        image.at(1, y) = glm::u8vec4(static_cast<uint8_t>(b));
      }
      const Texture2D texture(image, format);
      const float t = static_cast<float>(random() % 1000) / 1000.0f;
      glm::vec4 last = at(texture, kBilinearClamp, 0.0f, t);
      for (float s = 0.0f; s <= 1.0f; s += 0x1p-17f) {
        const glm::vec4 c = at(texture, kBilinearClamp, s, t);
        // For rgba8 and for alpha, the exact value is rounded once, so the result is exactly monotonic. For sRGB color, the difference of
        // the two rows is also rounded, by half an ulp.
        const float slack = format == TexelFormat::srgb8a8 ? c.x * 0x1p-23f : 0.0f;
        ASSERT_GE(c.x, last.x - slack) << s;
        ASSERT_GE(c.w, last.w) << s;
        last = c;
      }
    }
  }
}

TEST(Texture, FloatMatchesTheDoubleReference) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> any(-2.0f, 2.0f), lod(-1.0f, 7.0f);
  for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::srgb8a8}) {
    const Texture2D texture(noise(64, 32, 10), format);
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp}) {
      const Sampler sampler{Filter::bilinear, Filter::trilinear, wrap, wrap};
      for (int i = 0; i < 100000; ++i) {
        const float s = any(random), t = any(random), l = lod(random);
        const glm::dvec4 want = reference(texture, sampler, static_cast<double>(s), static_cast<double>(t), static_cast<double>(l));
        const glm::dvec4 in_double = at(texture, sampler, static_cast<double>(s), static_cast<double>(t), static_cast<double>(l));
        const glm::vec4 in_float = at(texture, sampler, s, t, l);
        for (int c = 0; c < 4; ++c) {
          EXPECT_NEAR(in_double[c], want[c], 1e-13);
          // The texel fraction has an error of 2^-16 from its rounding and of 64·2^-25 from the coordinate, on each axis. The level has an
          // error of 2^-14 next to an integer level. The contrast is at most 1.
          ASSERT_NEAR(static_cast<double>(in_float[c]), want[c], 2 * (0x1p-16 + 64 * 0x1p-25) + 0x1p-14) << s << ' ' << t << ' ' << l;
        }
      }
    }
  }
}

TEST(Texture, NearestMatchesOpenGl) {
  const Texture2D texture(noise(16, 8, 11), TexelFormat::rgba8);
  for (int i = -4000; i < 4000; ++i) {
    const double s = i / 1024.0, t = -i / 512.0 + 0.001;
    const float sf = static_cast<float>(s), tf = static_cast<float>(t);
    for (const Sampler& sampler : {kNearest, kNearestClamp}) {
      EXPECT_EQ(at(texture, sampler, sf, tf), glm::vec4(reference(texture, sampler, static_cast<double>(sf), static_cast<double>(tf), 0.0)))
          << s << ' ' << t;
    }
  }
}

TEST(Texture, MagnificationAndMinificationMeetAtLevelZero) {
  Image<glm::u8vec4> image(2, 1);
  image.at(1, 0) = {255, 255, 255, 255};
  const Texture2D texture(image, TexelFormat::rgba8);
  const Sampler sampler{Filter::nearest, Filter::bilinear, Wrap::clamp, Wrap::clamp};
  EXPECT_EQ(at(texture, sampler, 0.4f, 0.5f, 0.0f).x, 0.0f);    // λ <= 0 magnifies: nearest
  EXPECT_GT(at(texture, sampler, 0.4f, 0.5f, 0.001f).x, 0.2f);  // bilinear at level 0
  EXPECT_EQ(at(texture, sampler, 0.4f, 0.5f, 5.0f).x, at(texture, sampler, 0.4f, 0.5f, 0.001f).x);
  EXPECT_EQ(at(texture, sampler, 0.4f, 0.5f, kNaN).x, 0.0f);
  // A packet with lanes that magnify and lanes that minify.
  const RealN<4> lods = select(iota<IntN<4>>() < IntN<4>(2), RealN<4>(0.0f), RealN<4>(1.0f));
  const vec4<RealN<4>> mixed = at(texture, sampler, RealN<4>(0.4f), RealN<4>(0.5f), lods);
  EXPECT_EQ(lane(mixed.x, 1), 0.0f);
  EXPECT_EQ(lane(mixed.x, 2), at(texture, sampler, 0.4f, 0.5f, 1.0f).x);
}

// ---- level of detail ------------------------------------------------------------------------------------------------

TEST(Texture, LevelOfDetailMatchesOpenGl) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> exponent(-12.0, 2.0), unit(-1.0, 1.0);
  for (int i = 0; i < 100000; ++i) {
    const auto derivative = [&] { return glm::dvec2(unit(random), unit(random)) * std::exp2(exponent(random)); };
    const vec2<float> dx(derivative()), dy(derivative());
    const glm::dvec2 size(640, 480);
    const double rho = std::max(glm::length(glm::dvec2(dx) * size), glm::length(glm::dvec2(dy) * size));
    // log2 has an error of 1.04 ulp (at most 2^-20 here) and its argument has 4 roundings (4·2^-24/ln 2). Both are far below 1/256 of a
    // level, the precision of hardware.
    EXPECT_NEAR(static_cast<double>(level_of_detail(640, 480, dx, dy)), std::log2(rho), 0x1p-19);
  }
  EXPECT_EQ(level_of_detail(256, 256, vec2<float>(1.0f / 256.0f, 0.0f), vec2<float>(0.0f, 1.0f / 256.0f)), 0.0f);
  EXPECT_EQ(level_of_detail(256, 256, vec2<float>(1.0f / 64.0f, 0.0f), vec2<float>(0.0f, 1.0f / 256.0f)), 2.0f);
  EXPECT_EQ(level_of_detail(256, 256, vec2<float>(0.0f), vec2<float>(0.0f)), -kInf);
}

/// Returns a texture whose level l has the constant value 16·l, so that a lookup reveals its level of detail.
Texture2D level_ruler() {
  std::vector<Image<glm::u8vec4>> levels;
  for (int size = 256, l = 0; size >= 1; size /= 2, ++l) levels.push_back(constant(size, size, glm::u8vec4(static_cast<uint8_t>(16 * l))));
  return Texture2D(levels, TexelFormat::rgba8);
}

TEST(Texture, SampleSelectsTheLevelFromTheDerivatives) {
  const Texture2D ruler = level_ruler();
  for (double lod = -3.0; lod < 10.0; lod += 0.0137) {
    const auto step = static_cast<float>(std::exp2(lod) / 256.0);
    const vec4<float> c = ruler.sample(Sampler(), vec2<float>(0.3f, 0.7f), vec2<float>(step, 0.0f), vec2<float>(0.0f, step * 0.5f));
    const double got = static_cast<double>(c.x) * 255.0 / 16.0;
    EXPECT_NEAR(got, std::clamp(lod, 0.0, 8.0), 1.0 / 256.0);
    EXPECT_NEAR(got, std::clamp(lod, 0.0, 8.0), 0x1p-14 + 1e-6);  // actually much closer: only snapping to integer levels adds an error
  }
}

// ---- arbitrary bit patterns -------------------------------------------------------------------------------------------

TEST(Texture, LookupsOfFewerChannelsMatchSampleBits) {
  Sampler anisotropic, mirrored;
  anisotropic.anisotropy = 4;
  mirrored.wrap_s = Wrap::mirrored;
  std::mt19937 random(29);
  std::uniform_real_distribution<float> coordinate(-2, 3), change(-0.1f, 0.1f);
  for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::srgb8a8}) {
    const Texture2D texture(noise(33, 20, 28), format);
    for (const Sampler& sampler : {Sampler{}, kBilinearClamp, kNearest, anisotropic, mirrored}) {
      for (int i = 0; i < 100; ++i) {
        const vec2<float> uv(coordinate(random), coordinate(random)), dx(change(random), change(random)),
            dy(change(random), change(random));
        const vec4<float> all = texture.sample(sampler, uv, dx, dy);
        const vec3<float> rgb = texture.sample_rgb(sampler, uv, dx, dy);
        EXPECT_EQ(glm::vec4(rgb.x, rgb.y, rgb.z, texture.sample_alpha(sampler, uv, dx, dy)), glm::vec4(all.x, all.y, all.z, all.w));
        const auto wide = [](const vec2<float>& v) { return vec2<double>(v.x, v.y); };
        EXPECT_EQ(texture.sample_alpha(sampler, wide(uv), wide(dx), wide(dy)), texture.sample(sampler, wide(uv), wide(dx), wide(dy)).w);
      }
    }
  }
}

// Alpha has its own lookup. Textures with constant alpha skip it.
TEST(Texture, AlphaLookupMatchesSampleBits) {
  using R = FragmentReal;
  std::mt19937 random(31);
  std::uniform_real_distribution<float> coordinate(-2, 3), change(-0.1f, 0.1f);
  const auto values = [&](auto& distribution) {
    R r{};
    for (int i = 0; i < kWidthOf<R>; ++i) set_lane(r, i, distribution(random));
    return r;
  };
  Image<glm::u8vec4> same_alpha = noise(33, 20, 28);
  for (glm::u8vec4& texel : std::span(same_alpha.data(), 33 * 20)) texel.w = 77;
  Sampler anisotropic, bordered;
  anisotropic.anisotropy = 4;
  bordered.wrap_t = Wrap::border;
  for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::srgb8a8}) {
    for (const Texture2D& texture : {Texture2D(noise(33, 20, 28), format), Texture2D(same_alpha, format)}) {
      for (const Sampler& sampler : {Sampler{}, kBilinearClamp, kNearest, anisotropic, bordered}) {
        for (int i = 0; i < 50; ++i) {
          const vec2<R> uv(values(coordinate), values(coordinate)), dx(values(change), values(change)), dy(values(change), values(change));
          const R alpha = texture.sample_alpha(sampler, uv, dx, dy);
          for (int k = 0; k < kWidthOf<R>; ++k) {
            const auto in_lane = [k](const vec2<R>& v) { return vec2<float>(lane(v.x, k), lane(v.y, k)); };
            EXPECT_EQ(lane(alpha, k), texture.sample(sampler, in_lane(uv), in_lane(dx), in_lane(dy)).w);
          }
        }
      }
    }
  }
}

TEST(Texture, ExtremeCoordinatesAndDerivativesReturnValuesInRange) {
  const Texture2D texture(noise(7, 9, 13), TexelFormat::rgba8);
  const float wild[] = {0.0f, -0.0f, 0.5f,  1.0f,  -1.0f,  0x1p-149f, -0x1p-149f, -0x1p-30f, 8388609.0f, -8388609.5f,
                        3e9f, -3e9f, 1e20f, 3e38f, -3e38f, kInf,      -kInf,      kNaN,      -kNaN};
  for (const Sampler& sampler : {Sampler(), kBilinear, kBilinearClamp, kNearest, kNearestClamp,
                                 Sampler{Filter::nearest, Filter::trilinear, Wrap::clamp, Wrap::repeat}}) {
    for (const float s : wild) {
      for (const float t : wild) {
        for (const float d : wild) {
          const vec4<float> c = texture.sample(sampler, vec2<float>(s, t), vec2<float>(d, 0.0f), vec2<float>(s, d));
          const vec4<double> cd =
              texture.sample(sampler, vec2<double>(vec2<float>(s, t)), vec2<double>(vec2<float>(d, 0.0f)), vec2<double>(vec2<float>(s, d)));
          for (int k = 0; k < 4; ++k) {
            ASSERT_TRUE(c[k] >= 0.0f && c[k] <= 1.0f) << s << ' ' << t << ' ' << d;
            ASSERT_TRUE(cd[k] >= 0.0 && cd[k] <= 1.0 + 1e-15) << s << ' ' << t << ' ' << d;
          }
        }
      }
    }
  }
  // With clamp, infinities map to the edges and NaN to 0. With repeat, coordinates without a fraction map to 0.
  EXPECT_EQ(at(texture, kBilinearClamp, kInf, 0.5f), at(texture, kBilinearClamp, 1.0f, 0.5f));
  EXPECT_EQ(at(texture, kBilinearClamp, -kInf, 0.5f), at(texture, kBilinearClamp, 0.0f, 0.5f));
  EXPECT_EQ(at(texture, kBilinearClamp, kNaN, 0.5f), at(texture, kBilinearClamp, 0.0f, 0.5f));
  for (const float s : {kInf, -kInf, kNaN, 3e38f}) EXPECT_EQ(at(texture, kBilinear, s, 0.5f), at(texture, kBilinear, 0.0f, 0.5f)) << s;
}

TEST(Texture, RepeatHasPeriodOneAndClampExtendsTheEdge) {
  const Texture2D texture(noise(8, 8, 14), TexelFormat::srgb8a8);
  for (int i = 0; i < 4096; ++i) {
    const float s = static_cast<float>(i) / 4096.0f;  // exact, as are all sums below
    for (const float whole : {-5.0f, -1.0f, 1.0f, 100.0f})
      EXPECT_EQ(at(texture, kBilinear, s + whole, 0.3f), at(texture, kBilinear, s, 0.3f));
    EXPECT_EQ(at(texture, kBilinearClamp, 1.0f + s, 0.3f), at(texture, kBilinearClamp, 1.0f, 0.3f));
    EXPECT_EQ(at(texture, kBilinearClamp, -s, 0.3f), at(texture, kBilinearClamp, 0.0f, 0.3f));
  }
}

// ---- bit-exactness --------------------------------------------------------------------------------------------------

template <int W>
void expect_lanes_agree(const Texture2D& texture, const Sampler& sampler, bool same_level) {
  std::mt19937 random(15);
  std::uniform_real_distribution<float> any(-2.0f, 2.0f), exponent(-9.0f, 2.0f);
  for (int packet = 0; packet < 2000; ++packet) {
    vec2<RealN<W>> uv, dx, dy;
    float step = 0.0f;
    for (int k = 0; k < W; ++k) {
      if (k == 0 || !same_level) step = std::exp2(exponent(random));
      set_lane(uv.x, k, packet % 50 == 49 && k % 3 == 0 ? as_real(static_cast<int32_t>(random())) : any(random));
      set_lane(uv.y, k, any(random));
      set_lane(dx.x, k, step);
      set_lane(dx.y, k, step * 0.2f);
      set_lane(dy.x, k, step * -0.3f);
      set_lane(dy.y, k, step * 0.9f);
    }
    const vec4<RealN<W>> got = texture.sample(sampler, uv, dx, dy);
    for (int k = 0; k < W; ++k) {
      const auto one = [k](const vec2<RealN<W>>& v) { return vec2<float>(lane(v.x, k), lane(v.y, k)); };
      const vec4<float> want = texture.sample(sampler, one(uv), one(dx), one(dy));
      for (int c = 0; c < 4; ++c) ASSERT_EQ(as_int(lane(got[c], k)), as_int(want[c])) << one(uv).x << ' ' << one(uv).y;
    }
  }
}

TEST(Texture, LanesMatchScalarBits) {
  Image<glm::u8vec4> image = noise(37, 64, 16);
  std::fill_n(image.data(), 37 * 32, glm::u8vec4(0));  // zeros, whose sign must agree, too
  for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::srgb8a8}) {
    const Texture2D texture(image, format);
    for (const Sampler& sampler :
         {Sampler(), kBilinearClamp, kNearest, Sampler{Filter::nearest, Filter::trilinear, Wrap::clamp, Wrap::repeat}}) {
      for (const bool same_level : {true, false}) {
        expect_lanes_agree<4>(texture, sampler, same_level);
        expect_lanes_agree<8>(texture, sampler, same_level);
        if constexpr (kLanes == 16) expect_lanes_agree<16>(texture, sampler, same_level);
      }
    }
  }
}

}  // namespace
}  // namespace halfspace
