// SPDX-License-Identifier: Apache-2.0
//
// Tests every texel format, wrap mode and filter: exact results where the header guarantees them, comparison with an independent reference
// elsewhere, and bit-identical results at every width. texture_test.cpp tests 8-bit RGBA in more detail, anisotropy_test.cpp tests
// anisotropic filtering.
#include <gtest/gtest.h>

#include "halfspace/core/half.h"
#include "shading/texture_reference.h"
#include "support/constants.h"
#include "support/expected_hash.h"
#include "support/hash.h"

namespace halfspace {
namespace {

using test::kFormats;
using test::kWraps;

constexpr glm::ivec2 kSizes[] = {{8, 4}, {7, 5}, {1, 1}, {1, 13}, {33, 1}, {3, 2}};

template <class Function>
void for_each_sampler(const Function& function) {
  for (const Wrap s : kWraps) {
    for (const Wrap t : kWraps) {
      for (const Filter f : {Filter::nearest, Filter::bilinear, Filter::trilinear})
        function(Sampler{.mag = f == Filter::nearest ? f : Filter::bilinear, .min = f, .wrap_s = s, .wrap_t = t});
    }
  }
}

/// Returns the largest absolute value of the texels and the border, per channel.
glm::dvec4 magnitude(const Texture2D& texture, const Sampler& sampler) {
  glm::dvec4 m = glm::abs(test::border_of(texture, sampler));
  for (int y = 0; y < texture.height(); ++y) {
    for (int x = 0; x < texture.width(); ++x) m = glm::max(m, glm::abs(glm::dvec4(texture.value(0, x, y))));
  }
  return m;
}

// ---- texels -----------------------------------------------------------------------------------------------------------

TEST(TextureFormats, SingleChannelValuesAreReadExactly) {
  Image<uint8_t> r8(256, 1);
  Image<uint16_t> r16(256, 256);
  for (int c = 0; c < 256; ++c) r8.at(c, 0) = static_cast<uint8_t>(c);
  for (int c = 0; c < 65536; ++c) r16.at(c % 256, c / 256) = static_cast<uint16_t>(c);
  const Texture2D eight(r8), sixteen(r16);
  for (int c = 0; c < 256; ++c) EXPECT_EQ(eight.value(0, c, 0), glm::vec4(static_cast<float>(c / 255.0), 0, 0, 1));
  for (int c = 0; c < 65536; ++c) ASSERT_EQ(sixteen.value(0, c % 256, c / 256), glm::vec4(static_cast<float>(c / 65535.0), 0, 0, 1));
}

TEST(TextureFormats, IntegerValuesRoundTrip) {
  Image<glm::u8vec4> image(256, 1);
  for (int c = 0; c < 256; ++c) image.at(c, 0) = glm::u8vec4(static_cast<uint8_t>(c));
  const Texture2D plain(image, TexelFormat::rgba8), srgb(image, TexelFormat::srgb8a8);
  for (int c = 0; c < 256; ++c) {
    EXPECT_EQ(linear_to_unorm8(plain.value(0, c, 0).x), c);
    EXPECT_EQ(linear_to_srgb(srgb.value(0, c, 0).x), c);
    EXPECT_EQ(linear_to_unorm8(srgb.value(0, c, 0).w), c);
  }
}

TEST(TextureFormats, HalfFloatsAreKeptAndNonFiniteValuesAreClamped) {
  Image<glm::vec4> image(256, 256);
  for (int h = 0; h < 65536; ++h) image.at(h % 256, h / 256) = glm::vec4(half_to_float(static_cast<uint16_t>(h)));
  const Texture2D texture(image, TexelFormat::rgba16f);
  for (int h = 0; h < 65536; ++h) {
    const float x = half_to_float(static_cast<uint16_t>(h));
    const float want = std::isnan(x) ? 0.0f : std::clamp(x, -kMaxHalf, kMaxHalf);
    ASSERT_EQ(texture.value(0, h % 256, h / 256), glm::vec4(want)) << h;
  }
}

TEST(TextureFormats, FloatsAreKeptAndNonFiniteValuesAreClamped) {
  Image<glm::vec4> image(5, 1);
  image.at(0, 0) = {0x1p-149f, -1.5f, 1e30f, 0x1.fffffep-3f};
  image.at(1, 0) = {kInf, -kInf, kNaN, -kNaN};
  image.at(2, 0) = {3.4e38f, -3.4e38f, kMaxTexel, -kMaxTexel};
  const Texture2D texture(image, TexelFormat::rgba32f);
  EXPECT_EQ(texture.value(0, 0, 0), image.at(0, 0));
  EXPECT_EQ(texture.value(0, 1, 0), glm::vec4(kMaxTexel, -kMaxTexel, 0, 0));
  EXPECT_EQ(texture.value(0, 2, 0), glm::vec4(kMaxTexel, -kMaxTexel, kMaxTexel, -kMaxTexel));
}

TEST(TextureFormatsDeathTest, RejectsMismatchedImageFormats) {
  EXPECT_DEATH(Texture2D(Image<glm::u8vec4>(2, 2), TexelFormat::r8), "rgba8");
  EXPECT_DEATH(Texture2D(Image<glm::vec4>(2, 2), TexelFormat::srgb8a8), "rgba16f");
  EXPECT_DEATH(Texture2D(Image<uint8_t>(2, 2)).texel(0, 0, 0), "rgba8");
}

// ---- levels -----------------------------------------------------------------------------------------------------------

TEST(TextureFormats, R8LevelsMatchTheRedChannelOfRgba8) {
  const Texture2D r8 = test::make_noise(37, 22, TexelFormat::r8, 1), rgba8 = test::make_noise(37, 22, TexelFormat::rgba8, 1);
  ASSERT_EQ(r8.levels(), 6);
  for (int l = 0; l < r8.levels(); ++l) {
    for (int y = 0; y < r8.height(l); ++y) {
      for (int x = 0; x < r8.width(l); ++x) ASSERT_EQ(r8.value(l, x, y).x, rgba8.value(l, x, y).x);
    }
  }
}

TEST(TextureFormats, LevelsAreAreaAverages) {
  // Compares level 1 of 5 x 4 texels with the area-weighted average in double. Every level is computed from the previous one in the same
  // way.
  for (const TexelFormat format : {TexelFormat::r16, TexelFormat::rgba16f, TexelFormat::rgba32f}) {
    const Texture2D texture = test::make_noise(5, 4, format, 2);
    const double columns[2][5] = {{0.4, 0.4, 0.2, 0, 0}, {0, 0, 0.2, 0.4, 0.4}};
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 2; ++x) {
        glm::dvec4 want(0.0);
        for (int k = 0; k < 10; ++k) want += columns[x][k % 5] * 0.5 * glm::dvec4(texture.value(0, k % 5, 2 * y + k / 5));
        const glm::dvec4 got(texture.value(1, x, y));
        const double half_code = format == TexelFormat::r16 ? 0.5 / 65535 : 0.0;
        const double relative = format == TexelFormat::rgba16f ? 0x1p-11 : 0x1p-23;
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(got[c], want[c], half_code + std::fabs(want[c]) * relative + 0x1p-25 * (relative > 1e-4));
      }
    }
  }
}

// ---- filtering ----------------------------------------------------------------------------------------------------------

TEST(TextureFormats, ConstantsStayExact) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(-3.0f, 3.0f), exponent(-9.0f, 1.0f);
  for (const TexelFormat format : kFormats) {
    for (const uint32_t bits : {0x00000000u, 0xffffffffu, 0x12345678u, 0xa9fe0103u, 0x64c87f80u, 0x0d3b5581u}) {
      for (const glm::ivec2 size : kSizes) {
        const Texture2D texture = test::make_texture(size.x, size.y, format, [bits](int, int) { return bits; });
        const glm::vec4 want = texture.value(0, 0, 0);
        for_each_sampler([&](Sampler sampler) {
          sampler.border_color = want;
          for (const int anisotropy : {1, 3, 16}) {
            sampler.anisotropy = anisotropy;
            for (int i = 0; i < 10; ++i) {
              const auto derivative = [&] { return vec2<float>(any(random), any(random)) * std::exp2(exponent(random)); };
              ASSERT_EQ(texture.sample(sampler, vec2<float>(any(random), any(random)), derivative(), derivative()), want);
            }
          }
        });
      }
    }
  }
}

TEST(TextureFormats, ConstantFloatsOfAnyMagnitudeStayExact) {
  for (const float x : {0x1p-149f, 0x1.8p-140f, 0x1.fffffep-127f, 0.1f, 1.0f / 3.0f, 16777215.0f, kMaxTexel, -kMaxTexel}) {
    Image<glm::vec4> image(31, 9);
    std::fill_n(image.data(), 31 * 9, glm::vec4(x, -x, x * 0.5f, 1.0f));
    const Texture2D texture(image, TexelFormat::rgba32f);
    for (int l = 0; l < texture.levels(); ++l) ASSERT_EQ(texture.value(l, 0, 0), image.at(0, 0)) << x;
    Sampler sampler{.anisotropy = 16};
    for (int i = 0; i < 1000; ++i) {
      const float f = static_cast<float>(i) * 0x1p-10f;
      ASSERT_EQ(texture.sample(sampler, vec2<float>(f, 0.37f), vec2<float>(f, 0.01f), vec2<float>(0.0f, 0.2f)), image.at(0, 0));
    }
  }
}

TEST(TextureFormats, TexelCentersReturnTheTexel) {
  for (const TexelFormat format : kFormats) {
    for (const glm::ivec2 size : {glm::ivec2(8, 4), glm::ivec2(7, 5), glm::ivec2(200, 3), glm::ivec2(1, 1), glm::ivec2(64, 1)}) {
      const Texture2D texture = test::make_noise(size.x, size.y, format, 4);
      for_each_sampler([&](const Sampler& sampler) {
        for (int y = 0; y < size.y; ++y) {
          for (int x = 0; x < size.x; ++x) {
            const vec2<float> uv((static_cast<float>(x) + 0.5f) / static_cast<float>(size.x),
                                 (static_cast<float>(y) + 0.5f) / static_cast<float>(size.y));
            ASSERT_EQ(texture.sample_level(sampler, uv, 0.0f), texture.value(0, x, y)) << x << ' ' << y;
          }
        }
      });
    }
  }
}

TEST(TextureFormats, EveryWrapModeMatchesOpenGl) {
  // The coordinates are multiples of 2^-10, so their products with the sizes are exact. This also makes nearest filtering exact at the
  // edges between texels.
  std::mt19937 random(5);
  for (const TexelFormat format : kFormats) {
    for (const glm::ivec2 size : kSizes) {
      const Texture2D texture = test::make_noise(size.x, size.y, format, 6);
      for_each_sampler([&](Sampler sampler) {
        sampler.border_color = {0.25f, 1.0f, 0.0f, 0.5f};
        const glm::dvec4 scale = magnitude(texture, sampler);
        for (int i = 0; i < 200; ++i) {
          const auto coordinate = [&] { return (static_cast<float>(random() % 8192) - 4096.0f) * 0x1p-10f; };
          const vec2<float> uv(coordinate(), coordinate());
          const float lod = static_cast<float>(random() % 1024) / 256.0f - 0.5f;
          const test::Mixed want =
              test::reference(texture, sampler, static_cast<double>(uv.x), static_cast<double>(uv.y), static_cast<double>(lod));
          const vec4<float> got = texture.sample_level(sampler, uv, lod);
          const vec4<double> in_double = texture.sample_level(sampler, vec2<double>(uv), static_cast<double>(lod));
          for (int c = 0; c < 4; ++c) {
            if (sampler.min == Filter::nearest) {
              ASSERT_EQ(got[c], static_cast<float>(want.value[c])) << uv.x << ' ' << uv.y;
            } else {
              // The tolerance is derived as in texture_test.cpp: the rounding of the fraction on two axes and two levels, and the snapping
              // of the level. The rounding of stored values to integers does not matter, because the reference reads the same levels.
              ASSERT_NEAR(static_cast<double>(got[c]), want.value[c], 2 * scale[c] * (2 * 0x1p-16 + 0x1p-14)) << uv.x << ' ' << uv.y;
              ASSERT_NEAR(in_double[c], want.value[c], scale[c] * 1e-7) << uv.x << ' ' << uv.y;
            }
          }
        }
      });
    }
  }
}

TEST(TextureFormats, ResultsStayWithinTheRangeOfTheirTexels) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1.6f, 1.6f), lods(-1.0f, 4.0f);
  for (const TexelFormat format : kFormats) {
    const Texture2D texture = test::make_noise(9, 6, format, 8);
    for_each_sampler([&](Sampler sampler) {
      if (sampler.min == Filter::nearest) return;
      sampler.border_color = {0.25f, 1.0f, 0.0f, 0.5f};
      for (int i = 0; i < 500; ++i) {
        const vec2<float> uv(any(random), any(random));
        const float lod = lods(random);
        // Near a line through texel centers, the reference may select the adjacent cell, so such points are skipped.
        bool unsure = false;
        for (int l = 0; l < texture.levels(); ++l) {
          const auto near = [](float x) { return std::fabs(x - std::round(x)) < 1e-4f; };
          unsure |= near(uv.x * static_cast<float>(texture.width(l)) - 0.5f) || near(uv.y * static_cast<float>(texture.height(l)) - 0.5f);
        }
        if (unsure) continue;
        const test::Mixed want =
            test::reference(texture, sampler, static_cast<double>(uv.x), static_cast<double>(uv.y), static_cast<double>(lod));
        const vec4<float> got = texture.sample_level(sampler, uv, lod);
        for (int c = 0; c < 4; ++c) {
          ASSERT_GE(static_cast<double>(got[c]), want.low[c]) << uv.x << ' ' << uv.y << ' ' << lod;
          ASSERT_LE(static_cast<double>(got[c]), want.high[c]) << uv.x << ' ' << uv.y << ' ' << lod;
        }
      }
    });
  }
}

TEST(TextureFormats, R8MatchesTheRedChannelOfRgba8) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> any(-2.0f, 2.0f), lods(-1.0f, 6.0f);
  const Texture2D r8 = test::make_noise(37, 22, TexelFormat::r8, 1), rgba8 = test::make_noise(37, 22, TexelFormat::rgba8, 1);
  for_each_sampler([&](const Sampler& sampler) {
    for (int i = 0; i < 1000; ++i) {
      const vec2<float> uv(any(random), any(random));
      const float lod = lods(random);
      ASSERT_EQ(r8.sample_level(sampler, uv, lod), glm::vec4(rgba8.sample_level(sampler, uv, lod).x, 0.0f, 0.0f, 1.0f));
    }
  });
}

TEST(TextureFormats, MirroredRepeatsBackAndForth) {
  for (const TexelFormat format : kFormats) {
    const Texture2D texture = test::make_noise(13, 8, format, 10);
    const Sampler mirrored{.wrap_s = Wrap::mirrored, .wrap_t = Wrap::mirrored}, clamped{.wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};
    for (int i = 0; i <= 1024; ++i) {
      const float s = static_cast<float>(i) / 1024.0f;  // exact, as are all sums below
      const vec4<float> want = texture.sample_level(clamped, vec2<float>(s, 0.3f), 0.4f);
      for (const float same : {s, -s, 2.0f - s, 2.0f + s, s - 2.0f, 100.0f + s, -100.0f - s})
        ASSERT_EQ(texture.sample_level(mirrored, vec2<float>(same, 0.3f), 0.4f), want) << same;
    }
  }
}

TEST(TextureFormats, BorderReturnsTheBorderColor) {
  const glm::vec4 color(0.3f, 2.0f, -1.0f, kNaN);
  for (const TexelFormat format : kFormats) {
    const Texture2D texture = test::make_noise(4, 4, format, 11);
    const Sampler sampler{.wrap_s = Wrap::border, .wrap_t = Wrap::clamp, .border_color = color};
    const bool one = format == TexelFormat::r8 || format == TexelFormat::r16;
    const bool floats = format == TexelFormat::rgba16f || format == TexelFormat::rgba32f;
    const glm::vec4 want = one      ? glm::vec4(0.3f, 0.0f, 0.0f, 1.0f)
                           : floats ? glm::vec4(0.3f, 2.0f, -1.0f, 0.0f)
                                    : glm::vec4(0.3f, 1.0f, 0.0f, 0.0f);
    for (const float s : {-0.125f, 1.125f, -7.0f, 1e30f, -kInf, kInf, kNaN})
      EXPECT_EQ(texture.sample_level(sampler, vec2<float>(s, 0.3f), 0.0f), want) << s;
    // On the edge, the texel and the border have the same weight.
    const glm::vec4 edge = texture.sample_level(sampler, vec2<float>(0.0f, 0.125f), 0.0f);
    EXPECT_NEAR(edge.x, 0.5f * (texture.value(0, 0, 0).x + 0.3f), std::fabs(edge.x) * 1e-6f);
  }
}

// ---- arbitrary bit patterns -------------------------------------------------------------------------------------------

TEST(TextureFormats, ExtremeCoordinatesAndDerivativesReturnValuesInRange) {
  const float wild[] = {0.0f, -0.0f, 0.5f, 1.0f, -1.0f, 0x1p-149f, -0x1p-30f, 8388609.0f, -8388609.5f, 1e20f, -3e38f, kInf, -kInf, kNaN};
  for (const TexelFormat format : kFormats) {
    const Texture2D texture = test::make_noise(7, 9, format, 12);
    for_each_sampler([&](Sampler sampler) {
      const glm::dvec4 max_magnitude = magnitude(texture, sampler);
      for (const int anisotropy : {1, 16}) {
        sampler.anisotropy = anisotropy;
        for (const float s : wild) {
          for (const float t : wild) {
            for (const float d : wild) {
              const vec2<float> uv(s, t), dx(d, 0.01f), dy(t, d);
              const vec4<float> c = texture.sample(sampler, uv, dx, dy);
              const vec4<double> cd = texture.sample(sampler, vec2<double>(uv), vec2<double>(dx), vec2<double>(dy));
              for (int k = 0; k < 4; ++k) {
                ASSERT_TRUE(std::fabs(static_cast<double>(c[k])) <= max_magnitude[k]) << s << ' ' << t << ' ' << d;
                ASSERT_TRUE(std::fabs(cd[k]) <= max_magnitude[k] * (1 + 1e-6)) << s << ' ' << t << ' ' << d;
              }
            }
          }
        }
      }
    });
  }
}

TEST(TextureFormats, RandomBitPatternsReturnValuesInRange) {
  std::mt19937 random(13);
  const auto bits = [&] { return as_real(static_cast<int32_t>(random())); };
  for (const TexelFormat format : kFormats) {
    const Texture2D texture = test::make_noise(5, 12, format, 14);
    for_each_sampler([&](Sampler sampler) {
      sampler.anisotropy = 1 + static_cast<int>(random() % 16);
      for (int i = 0; i < 300; ++i) {
        const vec4<float> c =
            texture.sample(sampler, vec2<float>(bits(), bits()), vec2<float>(bits(), bits()), vec2<float>(bits(), bits()));
        for (int k = 0; k < 4; ++k) ASSERT_TRUE(std::fabs(c[k]) <= 256.0f);
      }
    });
  }
}

// ---- bit-exactness ------------------------------------------------------------------------------------------------------

struct Point {
  float s, t, dsdx, dtdx, dsdy, dtdy;
};
std::vector<Point> points(int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<float>(static_cast<int32_t>(random() % 65536) - 32768) * 0x1p-15f; };  // [−1, 1)
  const auto derivative = [&] {
    const float direction = unit(), size = static_cast<float>(1 + random() % 1000);
    return direction * size * std::ldexp(1.0f, -static_cast<int>(4 + random() % 12));
  };
  std::vector<Point> all;
  for (int i = 0; i < count; ++i) {
    all.push_back({2 * unit(), 2 * unit(), derivative(), derivative(), derivative(), derivative()});
    if (i % 50 == 49) all.back().dsdx = as_real(static_cast<int32_t>(random()));
  }
  return all;
}

template <class R>
vec4<R> sample_points(const Texture2D& texture, const Sampler& sampler, const Point* p) {
  vec2<R> uv, dx, dy;
  for (int k = 0; k < kWidthOf<R>; ++k) {
    set_lane(uv.x, k, p[k].s);
    set_lane(uv.y, k, p[k].t);
    set_lane(dx.x, k, p[k].dsdx);
    set_lane(dx.y, k, p[k].dtdx);
    set_lane(dy.x, k, p[k].dsdy);
    set_lane(dy.y, k, p[k].dtdy);
  }
  return texture.sample(sampler, uv, dx, dy);
}

template <int W>
void expect_lanes_agree(const Texture2D& texture, const Sampler& sampler, const std::vector<Point>& all) {
  for (std::size_t i = 0; i + W <= all.size(); i += W) {
    const vec4<RealN<W>> got = sample_points<RealN<W>>(texture, sampler, &all[i]);
    for (int k = 0; k < W; ++k) {
      const vec4<float> want = sample_points<float>(texture, sampler, &all[i + static_cast<std::size_t>(k)]);
      for (int c = 0; c < 4; ++c) ASSERT_EQ(as_int(lane(got[c], k)), as_int(want[c])) << W << " lanes, point " << i;
    }
  }
}

TEST(TextureFormats, LanesMatchScalarBits) {
  const std::vector<Point> all = points(160, 15);
  for (const TexelFormat format : kFormats) {
    const Texture2D texture = test::make_noise(37, 64, format, 16);
    for_each_sampler([&](Sampler sampler) {
      sampler.border_color = {0.7f, 0.1f, 0.2f, 0.9f};
      for (const int anisotropy : {1, 2, 16}) {
        sampler.anisotropy = anisotropy;
        expect_lanes_agree<4>(texture, sampler, all);
        expect_lanes_agree<8>(texture, sampler, all);
        if constexpr (kLanes == 16) expect_lanes_agree<16>(texture, sampler, all);
      }
    });
  }
}

TEST(TextureFormats, MatchesTheCommittedHash) {
  const std::vector<Point> all = points(512, 17);
  Hash hash;
  for (const TexelFormat format : kFormats) {
    const Texture2D texture = test::make_noise(37, 64, format, 18);
    for_each_sampler([&](Sampler sampler) {
      if (sampler.wrap_s == Wrap::mirrored_clamp || sampler.wrap_t == Wrap::mirrored_clamp) return;  // newer than the hash
      sampler.border_color = {0.7f, 0.1f, 0.2f, 0.9f};
      for (const int anisotropy : {1, 2, 16}) {
        sampler.anisotropy = anisotropy;
        for (std::size_t i = 0; i < all.size(); i += kLanes) {
          const vec4<Real> c = sample_points<Real>(texture, sampler, &all[i]);
          for (int k = 0; k < kLanes; ++k) {
            for (int channel = 0; channel < 4; ++channel) hash.add(static_cast<uint32_t>(as_int(lane(c[channel], k))));
          }
        }
      }
    });
  }
  expect_hash("texture-look-ups", hash.value());
}

}  // namespace
}  // namespace halfspace
