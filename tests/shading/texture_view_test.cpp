// SPDX-License-Identifier: Apache-2.0
//
// Tests textures of every kind and format in the caller's memory: all codes of every format, closed forms of filters, levels and
// comparisons, a reference in double on integer texel indices (OpenGL 4.6, section 8.14), and bit-identical results at every width.
#include "halfspace/shading/texture/texture_view.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <random>

#include "halfspace/core/cube_map.h"
#include "halfspace/core/texel_codec.h"
#include "halfspace/shading/environment/environment.h"
#include "halfspace/shading/texture/texture_memory.h"
#include "shading/texture_reference.h"

namespace halfspace {
namespace texture_views {
namespace {

constexpr CompareOp kAllOps[] = {CompareOp::never,   CompareOp::less,      CompareOp::equal,         CompareOp::less_equal,
                                 CompareOp::greater, CompareOp::not_equal, CompareOp::greater_equal, CompareOp::always};

std::vector<TexelFormat> all_formats() {
  std::vector<TexelFormat> formats;
  for (std::size_t f = 1; f < kTexelFormats; ++f) formats.push_back(static_cast<TexelFormat>(f));
  return formats;
}
std::vector<TexelFormat> real_formats() {
  std::vector<TexelFormat> formats = all_formats();
  std::erase_if(formats, [](TexelFormat f) { return is_integer(f); });
  return formats;
}

/// Fills all bytes of a level with random bits, except that floats get random values in [−2, 2].
void fill_with_noise(const TexelView& view, unsigned seed) {
  std::mt19937 random(seed);
  for (int z = 0; z < view.layers; ++z) {
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        std::byte* texel = view.at(x, y, z);
        for (int k = 0; k < texel_info(view.format).bytes; ++k) texel[k] = static_cast<std::byte>(random() & 255);
        if (is_integer(view.format)) continue;
        const auto number = [&] { return static_cast<float>(random()) * (4.0f / 4294967296.0f) - 2.0f; };
        encode_texel(view.format, {number(), number(), number(), number()}, texel);
      }
    }
  }
}
template <TextureKind kind>
std::unique_ptr<TextureMemory> noise(TexelFormat format, const TextureSize& size, int levels = 1, unsigned seed = 7) {
  auto memory = std::make_unique<TextureMemory>(kind, format, size, levels);
  for (int k = 0; k < levels; ++k) fill_with_noise(memory->level(k), seed + static_cast<unsigned>(k));
  return memory;
}

// ---- formats ----------------------------------------------------------------------------------------------------------------------------

// A 256 x 256 texture in which every 16-bit pattern occurs at every position of 16 bits within a texel.
TEST(TextureViews, EveryFormatReadsEveryCode) {
  for (const TexelFormat format : real_formats()) {
    TextureMemory memory(TextureKind::two_d, format, {256, 256});
    const TexelView view = memory.level();
    const int bytes = texel_info(format).bytes;
    for (int code = 0; code < 65536; ++code) {
      for (int k = 0; k < bytes; ++k) view.at(code % 256, code / 256)[k] = static_cast<std::byte>(code >> (8 * (k % 2)));
    }
    const Texture2DView texture = memory.view<TextureKind::two_d>();
    for (int code = 0; code < 65536; ++code) {
      const ivec3<float> at(code % 256, code / 256, 0);
      const vec4<float> read = texture.fetch<float>(at);
      const glm::vec4 expected = decode_texel(format, view.at(at.x, at.y));
      for (int k = 0; k < 4; ++k) {
        ASSERT_TRUE(std::bit_cast<uint32_t>(read[k]) == std::bit_cast<uint32_t>(expected[k]) ||
                    (read[k] != read[k] && expected[k] != expected[k]))
            << texel_info(format).name << ", code " << code << ", channel " << k << ": " << read[k] << ", expected " << expected[k];
      }
    }
  }
}

TEST(TextureViews, IntegerFormatsReadEveryCode) {
  for (const TexelFormat format : all_formats()) {
    if (!is_integer(format)) continue;
    TextureMemory memory(TextureKind::two_d, format, {256, 256});
    const TexelView view = memory.level();
    for (int code = 0; code < 65536; ++code) {
      for (int k = 0; k < texel_info(format).bytes; ++k) view.at(code % 256, code / 256)[k] = static_cast<std::byte>(code >> (8 * (k % 2)));
    }
    const Texture2DView texture = memory.view<TextureKind::two_d>();
    for (int code = 0; code < 65536; ++code) {
      const ivec4<float> read = texture.fetch_integers<float>(ivec3<float>(code % 256, code / 256, 0));
      const glm::ivec4 expected = decode_integers(format, view.at(code % 256, code / 256));
      ASSERT_EQ(glm::ivec4(read.x, read.y, read.z, read.w), expected) << texel_info(format).name << ", code " << code;
    }
  }
}

TEST(TextureViews, StencilIsReadAsIntegers) {
  for (const TexelFormat format : {TexelFormat::d24s8, TexelFormat::d32fs8}) {
    TextureMemory memory(TextureKind::two_d, format, {256, 1});
    for (int s = 0; s < 256; ++s) memory.level().at(s, 0)[format == TexelFormat::d24s8 ? 0 : 4] = static_cast<std::byte>(s);
    const Texture2DView texture = memory.view<TextureKind::two_d>();
    for (int s = 0; s < 256; ++s) EXPECT_EQ(texture.fetch_integers<float>(ivec3<float>(s, 0, 0)).x, s);
  }
  for (const TexelFormat format : {TexelFormat::d16, TexelFormat::d24, TexelFormat::d32f}) {
    TextureMemory memory(TextureKind::two_d, format, {1, 1});
    std::memset(memory.level().data, 0xff, texel_info(format).bytes);
    EXPECT_EQ(memory.view<TextureKind::two_d>().fetch_integers<float>(ivec3<float>(0)).x, 0);
  }
}

// ---- the same bits as Texture2D, and at every width
// ---------------------------------------------------------------------------------------

bool same_bits(const vec4<float>& a, const vec4<float>& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(TextureViews, AViewEqualsATexture2DOfTheSameTexels) {
  for (const TexelFormat format : test::kFormats) {
    const Texture2D copy = test::make_noise(16, 8, format, 5);
    TextureMemory memory(TextureKind::two_d, format, {16, 8}, copy.levels());
    for (int k = 0; k < copy.levels(); ++k) {
      for (int y = 0; y < copy.height(k); ++y) {
        for (int x = 0; x < copy.width(k); ++x) memory.set(x, y, 0, k, copy.value(k, x, y));
      }
    }
    const Texture2DView view = memory.view<TextureKind::two_d>();
    std::mt19937 random(3);
    std::uniform_real_distribution<float> number(-2.5f, 2.5f), lod(-1.0f, 5.0f);
    for (const Wrap wrap : test::kWraps) {
      for (int filter = 0; filter < 6; ++filter) {
        for (const Filter mag : {Filter::nearest, Filter::bilinear}) {
          const Sampler sampler{
              .mag = mag, .min = static_cast<Filter>(filter), .wrap_s = wrap, .wrap_t = wrap, .border_color = {0.25f, 0.5f, 2.0f, -1.0f}};
          for (int i = 0; i < 20; ++i) {
            const vec2<float> uv(number(random), number(random));
            const float level = lod(random);
            ASSERT_TRUE(same_bits(copy.sample_level<float>(sampler, uv, level), view.sample_level(sampler, uv, level)))
                << texel_info(format).name << ", wrap " << static_cast<int>(wrap) << ", filter " << filter;
            Sampler probes = sampler;
            probes.anisotropy = 4;
            const vec2<float> dx(0.2f * number(random), 0.1f), dy(0.01f, 0.02f);
            ASSERT_TRUE(same_bits(copy.sample<float>(probes, uv, dx, dy), view.sample(probes, uv, dx, dy)));
          }
        }
      }
    }
  }
}

template <class Lanes, TextureKind kind>
void expect_lanes_equal_scalars(const TextureView<kind>& texture, const Sampler& sampler, unsigned seed) {
  constexpr int width = kWidthOf<Lanes>;
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(-2.5f, 2.5f), slope(-0.2f, 0.2f);
  using P = TextureCoordinates<kind, Lanes>;
  using D = TextureDerivatives<kind, Lanes>;
  using ScalarP = TextureCoordinates<kind, float>;
  using ScalarD = TextureDerivatives<kind, float>;
  const auto fill = [&](auto& lanes, auto& scalars, auto& distribution) {
    constexpr int count = sizeof(scalars[0]) / sizeof(float);
    std::array<std::array<float, width>, 4> values;
    for (int c = 0; c < count; ++c) {
      for (int k = 0; k < width; ++k) {
        const float v = distribution(random);
        values[static_cast<std::size_t>(c)][static_cast<std::size_t>(k)] = v;
        std::memcpy(reinterpret_cast<float*>(&scalars[static_cast<std::size_t>(k)]) + c, &v, sizeof v);
      }
      std::memcpy(reinterpret_cast<Lanes*>(&lanes) + c, values[static_cast<std::size_t>(c)].data(), sizeof(Lanes));
    }
  };
  for (int round = 0; round < 4; ++round) {
    P p;
    D dx, dy;
    std::array<ScalarP, width> scalar_p;
    std::array<ScalarD, width> scalar_dx, scalar_dy;
    fill(p, scalar_p, number);
    fill(dx, scalar_dx, slope);
    fill(dy, scalar_dy, slope);
    const LookupOptions options{.bias = 0.25f, .offset = glm::ivec3(1, -2, 1)};
    const vec4<Lanes> color = texture.sample(sampler, p, dx, dy, options);
    const Lanes compared = texture.sample_compare(sampler, p, Lanes(0.4f), dx, dy, options);
    for (std::size_t k = 0; k < static_cast<std::size_t>(width); ++k) {
      const vec4<float> expected = texture.sample(sampler, scalar_p[k], scalar_dx[k], scalar_dy[k], options);
      const int at = static_cast<int>(k);
      ASSERT_TRUE(same_bits({lane(color.x, at), lane(color.y, at), lane(color.z, at), lane(color.w, at)}, expected));
      ASSERT_EQ(lane(compared, at), texture.sample_compare(sampler, scalar_p[k], 0.4f, scalar_dx[k], scalar_dy[k], options));
    }
  }
}

template <TextureKind kind>
void expect_same_bits_at_every_width(const TextureSize& size) {
  for (const TexelFormat format :
       {TexelFormat::rgb8, TexelFormat::rg16_snorm, TexelFormat::rgba16f, TexelFormat::d32f, TexelFormat::rgb9_e5}) {
    const int levels = kind == TextureKind::rectangle ? 1 : 3;
    const auto memory = noise<kind>(format, size, levels);
    const TextureView<kind> view = memory->template view<kind>();
    for (const Filter filter : {Filter::nearest, Filter::trilinear, Filter::bilinear_mipmap_nearest}) {
      for (const Wrap wrap : {Wrap::repeat, Wrap::border}) {
        const Sampler sampler{.mag = Filter::bilinear,
                              .min = filter,
                              .wrap_s = wrap,
                              .wrap_t = wrap,
                              .anisotropy = 3,
                              .border_color = glm::vec4(0.25f),
                              .wrap_r = wrap};
        expect_lanes_equal_scalars<RealN<4>>(view, sampler, 1);
        expect_lanes_equal_scalars<RealN<8>>(view, sampler, 2);
        expect_lanes_equal_scalars<FragmentReal>(view, sampler, 3);
      }
    }
  }
}

TEST(TextureViews, OneDGivesTheSameBitsAtEveryWidth) { expect_same_bits_at_every_width<TextureKind::one_d>({9, 1, 1}); }
TEST(TextureViews, TwoDGivesTheSameBitsAtEveryWidth) { expect_same_bits_at_every_width<TextureKind::two_d>({9, 6, 1}); }
TEST(TextureViews, RectangleGivesTheSameBitsAtEveryWidth) { expect_same_bits_at_every_width<TextureKind::rectangle>({9, 6, 1}); }
TEST(TextureViews, ThreeDGivesTheSameBitsAtEveryWidth) { expect_same_bits_at_every_width<TextureKind::three_d>({9, 6, 5}); }
TEST(TextureViews, OneDArrayGivesTheSameBitsAtEveryWidth) { expect_same_bits_at_every_width<TextureKind::one_d_array>({9, 1, 3}); }
TEST(TextureViews, TwoDArrayGivesTheSameBitsAtEveryWidth) { expect_same_bits_at_every_width<TextureKind::two_d_array>({9, 6, 3}); }
TEST(TextureViews, CubeGivesTheSameBitsAtEveryWidth) { expect_same_bits_at_every_width<TextureKind::cube>({6, 6, 6}); }
TEST(TextureViews, CubeArrayGivesTheSameBitsAtEveryWidth) { expect_same_bits_at_every_width<TextureKind::cube_array>({6, 6, 12}); }

// ---- filters against a reference in double
// ---------------------------------------------------------------------------------------------------

struct Taps {
  std::array<int, 2> index;  // −1: the border
  std::array<double, 2> weight;
};
Taps reference_taps(double coordinate, int size, Wrap wrap, bool nearest) {
  const double u = coordinate * size - (nearest ? 0.0 : 0.5), whole = std::floor(u);
  const auto at = [&](double i) { return test::wrapped_index(static_cast<int64_t>(i), size, wrap); };
  return {{at(whole), at(whole + 1)}, {nearest ? 1.0 : 1.0 - (u - whole), nearest ? 0.0 : u - whole}};
}

/// Filters level 0 of a texture with up to three axes.
glm::dvec4 reference_filter(const ConstTexelView& level, const glm::dvec3& p, const std::array<Wrap, 3>& wrap, const glm::dvec4& border,
                            bool nearest, bool volume, int layer) {
  const Taps x = reference_taps(p.x, level.width, wrap[0], nearest), y = reference_taps(p.y, level.height, wrap[1], nearest);
  const Taps z = volume ? reference_taps(p.z, level.layers, wrap[2], nearest) : Taps{{layer, layer}, {1.0, 0.0}};
  glm::dvec4 sum(0.0);
  for (std::size_t n = 0; n < 8; ++n) {
    const std::size_t i = n % 2, j = n / 2 % 2, k = n / 4;
    const double weight = x.weight[i] * y.weight[j] * z.weight[k];
    const bool inside = x.index[i] >= 0 && y.index[j] >= 0 && z.index[k] >= 0;
    if (weight != 0.0)
      sum += weight * (inside ? glm::dvec4(decode_texel(level.format, level.at(x.index[i], y.index[j], z.index[k]))) : border);
  }
  return sum;
}

// Texel fractions are rounded to 2^-15, so each of the three axes may err by 2^-16 of the largest difference of two texels, which is 4.
constexpr double kFilterTolerance = 3 * 4.0 / 65536.0 + 1e-6;

template <TextureKind kind>
void expect_reference(const TextureSize& size) {
  constexpr bool volume = kind == TextureKind::three_d;
  const TexelFormat format = TexelFormat::rgba32f;
  const auto memory = noise<kind>(format, size);
  const TextureView<kind> view = memory->template view<kind>();
  std::mt19937 random(11);
  std::uniform_real_distribution<float> number(-2.5f, 2.5f);
  for (const Wrap s : test::kWraps) {
    for (const Wrap t : test::kWraps) {
      for (const bool nearest : {false, true}) {
        const Filter filter = nearest ? Filter::nearest : Filter::bilinear;
        const Sampler sampler{
            .mag = filter, .min = filter, .wrap_s = s, .wrap_t = t, .border_color = {1.0f, -2.0f, 0.5f, 0.25f}, .wrap_r = t};
        for (int i = 0; i < 40; ++i) {
          const glm::vec3 p(number(random), number(random), number(random));
          TextureCoordinates<kind, float> at;
          if constexpr (kind == TextureKind::one_d)
            at = p.x;
          else if constexpr (volume)
            at = {p.x, p.y, p.z};
          else if constexpr (kind == TextureKind::two_d_array)
            at = {p.x, p.y, 1.0f};
          else if constexpr (kind == TextureKind::rectangle)
            at = {p.x * static_cast<float>(size.width), p.y * static_cast<float>(size.height)};
          else
            at = {p.x, p.y};
          if constexpr (kind == TextureKind::rectangle) {
            if (s == Wrap::repeat || s == Wrap::mirrored || t == Wrap::repeat || t == Wrap::mirrored) continue;
          }
          const bool one = kind == TextureKind::one_d;
          const glm::dvec4 expected =
              reference_filter(memory->level(), glm::dvec3(p.x, one ? 0.5 : p.y, p.z), {s, one ? Wrap::clamp : t, t},
                               glm::dvec4(sampler.border_color), nearest, volume, kind == TextureKind::two_d_array ? 1 : 0);
          const vec4<float> color = view.sample_level(sampler, at, 0.0f);
          for (int k = 0; k < 4; ++k)
            ASSERT_NEAR(color[k], expected[k], kFilterTolerance)
                << "wrap " << static_cast<int>(s) << " " << static_cast<int>(t) << " at " << p.x << " " << p.y << " " << p.z;
        }
      }
    }
  }
}

TEST(TextureViews, OneDMatchesTheReference) { expect_reference<TextureKind::one_d>({7, 1, 1}); }
TEST(TextureViews, TwoDMatchesTheReference) { expect_reference<TextureKind::two_d>({7, 5, 1}); }
TEST(TextureViews, RectangleMatchesTheReference) { expect_reference<TextureKind::rectangle>({7, 5, 1}); }
TEST(TextureViews, ThreeDMatchesTheReference) { expect_reference<TextureKind::three_d>({7, 5, 3}); }
TEST(TextureViews, LayersMatchTheReference) { expect_reference<TextureKind::two_d_array>({7, 5, 3}); }

TEST(TextureViews, ALinearFieldOfAVolumeIsReproduced) {
  TextureMemory memory(TextureKind::three_d, TexelFormat::r32f, {8, 4, 16});
  for (int z = 0; z < 16; ++z) {
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 8; ++x) memory.set(x, y, z, 0, glm::vec4(static_cast<float>(x + 10 * y + 100 * z)));
    }
  }
  const Texture3DView view = memory.view<TextureKind::three_d>();
  const Sampler sampler{.min = Filter::bilinear};
  for (const glm::vec3 p : {glm::vec3(1.25f, 0.5f, 3.75f), glm::vec3(6.0f, 2.125f, 14.5f), glm::vec3(0.0f, 0.0f, 0.0f)}) {
    const vec3<float> uvw((p.x + 0.5f) / 8, (p.y + 0.5f) / 4, (p.z + 0.5f) / 16);
    EXPECT_EQ(view.sample_level(sampler, uvw, 0.0f).x, p.x + 10 * p.y + 100 * p.z);  // all fractions are multiples of 2^-15
  }
}

TEST(TextureViews, LayersRoundToTheNearestAndClamp) {
  TextureMemory memory(TextureKind::two_d_array, TexelFormat::r32f, {2, 2, 4});
  for (int layer = 0; layer < 4; ++layer) {
    for (int i = 0; i < 4; ++i) memory.set(i % 2, i / 2, layer, 0, glm::vec4(static_cast<float>(layer)));
  }
  const Texture2DArrayView view = memory.view<TextureKind::two_d_array>();
  const std::pair<float, float> cases[] = {{-5.0f, 0.0f}, {0.49f, 0.0f}, {0.5f, 1.0f}, {1.49f, 1.0f},
                                           {2.5f, 3.0f},  {99.0f, 3.0f}, {NAN, 0.0f}};
  for (const auto& [layer, expected] : cases)
    EXPECT_EQ(view.sample_level(Sampler{}, vec3<float>(0.3f, 0.7f, layer), 0.0f).x, expected) << layer;
}

// ---- levels -----------------------------------------------------------------------------------------------------------------------------

/// A chain whose level k is k everywhere, so that a lookup returns the level of detail that it uses.
std::unique_ptr<TextureMemory> numbered_levels(int size) {
  auto memory = std::make_unique<TextureMemory>(TextureKind::two_d, TexelFormat::r32f, TextureSize{size, size, 1},
                                                full_levels(TextureKind::two_d, {size, size, 1}));
  for (int k = 0; k < memory->levels(); ++k) {
    const TexelView level = memory->level(k);
    for (int i = 0; i < level.width * level.height; ++i)
      memory->set(i % level.width, i / level.width, 0, k, glm::vec4(static_cast<float>(k)));
  }
  return memory;
}

TEST(TextureLevels, FiltersSelectTheLevelsOfOpenGl) {
  const auto memory = numbered_levels(64);
  const Texture2DView view = memory->view<TextureKind::two_d>();
  const auto level = [&](Filter min, float lod) { return view.sample_level(Sampler{.min = min}, vec2<float>(0.4f, 0.6f), lod).x; };
  for (const float lod : {-3.0f, 0.0f, 0.25f, 0.5f, 0.75f, 1.0f, 1.25f, 1.5f, 1.75f, 2.5f, 5.75f, 6.0f, 9.0f}) {
    const float limited = std::clamp(lod, 0.0f, 6.0f), rounded = std::max(std::ceil(limited + 0.5f) - 1.0f, 0.0f);
    EXPECT_EQ(level(Filter::nearest, lod), 0.0f);
    EXPECT_EQ(level(Filter::bilinear, lod), 0.0f);
    EXPECT_EQ(level(Filter::trilinear, lod), limited);
    EXPECT_EQ(level(Filter::bilinear_mipmap_nearest, lod), rounded) << lod;
    EXPECT_EQ(level(Filter::nearest_mipmap_nearest, lod), lod <= 0.5f ? 0.0f : rounded) << lod;
    EXPECT_EQ(level(Filter::nearest_mipmap_linear, lod), lod <= 0.5f ? 0.0f : limited) << lod;  // section 8.15: c = 1/2
  }
}

TEST(TextureLevels, BiasAndLimitsApplyInThisOrder) {
  const auto memory = numbered_levels(64);
  const Texture2DView view = memory->view<TextureKind::two_d>();
  const vec2<float> uv(0.4f, 0.6f), one_texel(1.0f / 64, 0.0f), none(0.0f);
  const auto level = [&](const LodControl& lod, float scale, float bias) {
    return view.sample(Sampler{.lod = lod}, uv, one_texel * scale, none, {.bias = bias}).x;
  };
  EXPECT_EQ(level({}, 4.0f, 0.0f), 2.0f);
  EXPECT_EQ(level({.bias = 1.5f}, 4.0f, 0.0f), 3.5f);
  EXPECT_EQ(level({.bias = 1.5f}, 4.0f, -0.5f), 3.0f);
  EXPECT_EQ(level({.bias = 9.0f, .max = 2.5f}, 4.0f, 0.0f), 2.5f);
  EXPECT_EQ(level({.min = 3.0f}, 4.0f, 0.0f), 3.0f);
  EXPECT_EQ(level({.min = 3.0f}, 0.5f, 0.0f), 3.0f);  // a minimum above 0 also applies to magnification
  EXPECT_EQ(level({.max = -1.0f}, 8.0f, 0.0f), 0.0f);
  const vec2<float> lods = view.query_lod(Sampler{.lod = {.bias = 1.5f}}, uv, one_texel * 64.0f, none);
  EXPECT_EQ(lods.x, 6.0f);
  EXPECT_EQ(lods.y, 7.5f);
}

// The function ComputeAccessedLod of ARB_texture_query_lod.
TEST(TextureLevels, QueriesReturnTheAccessedLevelAndTheLevelBeforeTheLimits) {
  const auto memory = numbered_levels(64);
  const Texture2DView view = memory->view<TextureKind::two_d>();
  const auto query = [&](Filter min, const LodControl& lod) {
    const vec2<float> v =
        view.query_lod(Sampler{.min = min, .lod = lod}, vec2<float>(0.4f), vec2<float>(4.0f / 64, 0.0f), vec2<float>(0.0f));
    return glm::vec2(v.x, v.y);
  };
  EXPECT_EQ(query(Filter::trilinear, {.bias = 0.75f, .max = 2.5f}), glm::vec2(2.5f, 2.75f));
  EXPECT_EQ(query(Filter::trilinear, {.bias = -4.0f}), glm::vec2(0.0f, -2.0f));
  EXPECT_EQ(query(Filter::nearest_mipmap_linear, {.min = 3.25f}), glm::vec2(3.25f, 2.0f));
  EXPECT_EQ(query(Filter::nearest_mipmap_nearest, {.bias = 0.75f}), glm::vec2(3.0f, 2.75f));
  EXPECT_EQ(query(Filter::bilinear_mipmap_nearest, {.bias = 0.5f}), glm::vec2(2.0f, 2.5f));
  EXPECT_EQ(query(Filter::bilinear, {.bias = 0.5f}), glm::vec2(0.0f, 2.5f));
}

TEST(TextureLevels, BaseAndMaximumLevelAreAViewOfLevels) {
  const auto memory = numbered_levels(64);
  const Texture2DView view = memory->view<TextureKind::two_d>().part_of_levels(2, 3);
  EXPECT_EQ(view.width(), 16);
  EXPECT_EQ(view.levels(), 3);
  const auto level = [&](float lod) { return view.sample_level(Sampler{}, vec2<float>(0.4f, 0.6f), lod).x; };
  EXPECT_EQ(level(-1.0f), 2.0f);
  EXPECT_EQ(level(0.5f), 2.5f);
  EXPECT_EQ(level(9.0f), 4.0f);
}

TEST(TextureLevels, SamplersOfTexture2DHaveTheSameControls) {
  Image<glm::vec4> images[] = {Image<glm::vec4>(4, 4), Image<glm::vec4>(2, 2), Image<glm::vec4>(1, 1)};
  for (std::size_t k = 0; k < 3; ++k) {
    for (int i = 0; i < images[k].width() * images[k].height(); ++i)
      images[k].at(i % images[k].width(), i / images[k].width()) = glm::vec4(static_cast<float>(k));
  }
  const Texture2D texture(std::span<const Image<glm::vec4>>(images), TexelFormat::rgba32f);
  const vec2<float> uv(0.3f, 0.2f), dx(0.5f, 0.0f), dy(0.0f);  // level of detail 1
  EXPECT_EQ(texture.sample<float>(Sampler{}, uv, dx, dy).x, 1.0f);
  EXPECT_EQ(texture.sample<float>(Sampler{.lod = {.bias = 0.5f}}, uv, dx, dy).x, 1.5f);
  EXPECT_EQ(texture.sample<float>(Sampler{.lod = {.max = 0.25f}}, uv, dx, dy).x, 0.25f);
  EXPECT_EQ(texture.sample<float>(Sampler{.min = Filter::bilinear_mipmap_nearest, .lod = {.bias = 0.6f}}, uv, dx, dy).x, 2.0f);
}

// ---- channels, comparisons, gathers, offsets
// -----------------------------------------------------------------------------------------------

TEST(TextureViews, SwizzlesSelectChannels) {
  TextureMemory memory(TextureKind::two_d, TexelFormat::rgba32f, {1, 1});
  memory.set(0, 0, 0, 0, {2, 3, 4, 5});
  const Texture2DView view = memory.view<TextureKind::two_d>().swizzled(Swizzle::alpha, Swizzle::zero, Swizzle::red, Swizzle::one);
  EXPECT_EQ(glm::vec4(view.sample_level(Sampler{}, vec2<float>(0.5f), 0.0f)), glm::vec4(5, 0, 2, 1));
  EXPECT_EQ(glm::vec4(view.fetch<float>(ivec3<float>(0))), glm::vec4(5, 0, 2, 1));
  EXPECT_EQ(glm::vec4(view.gather(Sampler{}, vec2<float>(0.5f), 2)), glm::vec4(2));
}

TEST(TextureViews, BorderColorsAreClampedToTheRangeOfTheFormat) {
  const std::pair<TexelFormat, glm::vec4> cases[] = {
      {TexelFormat::rgba8, {0, 1, 0.5f, 0}},   {TexelFormat::rgba16_snorm, {-1, 1, 0.5f, -0.25f}},
      {TexelFormat::rgb16f, {-2, 3, 0.5f, 1}}, {TexelFormat::r11f_g11f_b10f, {0, 3, 0.5f, 1}},
      {TexelFormat::rgb9_e5, {0, 3, 0.5f, 1}}, {TexelFormat::d24, {0, 0, 0, 1}},
      {TexelFormat::d32f, {-2, 0, 0, 1}},      {TexelFormat::d32fs8, {-2, 0, 0, 1}}};
  for (const auto& [format, expected] : cases) {
    TextureMemory memory(TextureKind::two_d, format, {1, 1});
    const Sampler sampler{.wrap_s = Wrap::border, .border_color = {-2.0f, 3.0f, 0.5f, -0.25f}};
    const Texture2DView view = memory.view<TextureKind::two_d>();
    EXPECT_EQ(glm::vec4(view.sample_level(sampler, vec2<float>(9.0f), 0.0f)), expected) << texel_info(format).name;
  }
}

TEST(TextureComparison, SwizzlesApplyToTheResults) {
  TextureMemory memory(TextureKind::two_d, TexelFormat::d32f, {1, 1});
  memory.set(0, 0, 0, 0, glm::vec4(0.5f));
  const std::pair<Swizzle, float> cases[] = {{Swizzle::red, 1.0f},   {Swizzle::green, 0.0f}, {Swizzle::blue, 0.0f},
                                             {Swizzle::alpha, 1.0f}, {Swizzle::zero, 0.0f},  {Swizzle::one, 1.0f}};
  for (const auto& [red, passed] : cases) {
    const Texture2DView view = memory.view<TextureKind::two_d>().swizzled(red, Swizzle::zero, Swizzle::zero, Swizzle::zero);
    const vec2<float> uv(0.5f), none(0.0f);
    EXPECT_EQ(view.sample_compare_level(Sampler{}, uv, 0.25f, 0.0f), passed);
    EXPECT_EQ(view.sample_compare(Sampler{}, uv, 0.25f, none, none), passed);
    EXPECT_EQ(glm::vec4(view.gather_compare(Sampler{}, uv, 0.25f)), glm::vec4(passed));
    const float failed = red == Swizzle::alpha || red == Swizzle::one ? 1.0f : 0.0f;
    EXPECT_EQ(view.sample_compare_level(Sampler{}, uv, 0.75f, 0.0f), failed);
  }
}

TEST(TextureComparison, EveryOperatorFiltersItsResults) {
  for (const TexelFormat format : {TexelFormat::d16, TexelFormat::d24, TexelFormat::d32f, TexelFormat::d24s8, TexelFormat::d32fs8}) {
    TextureMemory memory(TextureKind::two_d, format, {2, 2});
    const float depths[] = {0.0f, 0.25f, 1.0f, 0.75f};
    for (int i = 0; i < 4; ++i) memory.set(i % 2, i / 2, 0, 0, glm::vec4(depths[i]));
    const Texture2DView view = memory.view<TextureKind::two_d>();
    const float reference = view.fetch<float>(ivec3<float>(1, 0, 0)).x;                // 0.25 as stored
    const float weights[] = {0.75f * 0.5f, 0.25f * 0.5f, 0.75f * 0.5f, 0.25f * 0.5f};  // at (3/4, 1) in texels
    for (const CompareOp op : kAllOps) {
      float expected = 0.0f;
      for (int i = 0; i < 4; ++i) {
        const float d = view.fetch<float>(ivec3<float>(i % 2, i / 2, 0)).x;
        const bool passes[] = {false, reference<d, reference == d, reference <= d, reference> d, reference != d, reference >= d, true};
        if (passes[static_cast<std::size_t>(op)]) expected += weights[i];
      }
      const Sampler sampler{.min = Filter::bilinear, .compare = op};
      EXPECT_EQ(view.sample_compare_level(sampler, vec2<float>(0.375f, 0.5f), reference, 0.0f), expected) << static_cast<int>(op);
    }
    // Beyond [0, 1], a reference is clamped unless the format has floats.
    const bool clamped = texel_info(format).name.find('f') == std::string_view::npos;
    const Sampler equal{.mag = Filter::nearest, .min = Filter::nearest, .compare = CompareOp::equal};
    EXPECT_EQ(view.sample_compare_level(equal, vec2<float>(0.25f, 0.75f), 1.5f, 0.0f), clamped ? 1.0f : 0.0f);
  }
}

TEST(TextureGather, ReturnsTheFourTexelsThatABilinearLookupBlends) {
  const auto memory = noise<TextureKind::two_d>(TexelFormat::rgba16, {5, 4});
  const Texture2DView view = memory->view<TextureKind::two_d>();
  const Sampler sampler{};
  std::mt19937 random(2);
  std::uniform_real_distribution<float> number(0.13f, 0.87f);  // so that no texel is beyond an edge
  for (int i = 0; i < 100; ++i) {
    const vec2<float> uv(number(random), number(random));
    const int x = static_cast<int>(std::floor(uv.x * 5 - 0.5f)), y = static_cast<int>(std::floor(uv.y * 4 - 0.5f));
    const int component = i % 4;
    const auto texel = [&](int column, int row) {
      return view.fetch<float>(ivec3<float>(std::min(column, 4), std::min(row, 3), 0))[component];
    };
    const vec4<float> four = view.gather(sampler, uv, component);
    EXPECT_EQ(glm::vec4(four), glm::vec4(texel(x, y + 1), texel(x + 1, y + 1), texel(x + 1, y), texel(x, y)));
    const float reference = texel(x, y);
    if (component == 0) {
      const vec4<float> passed = view.gather_compare(sampler, uv, reference);
      for (int k = 0; k < 4; ++k) EXPECT_EQ(passed[k], reference <= four[k] ? 1.0f : 0.0f);
    }
  }
}

TEST(TextureGather, ReturnsIntegersWithoutRounding) {
  TextureMemory memory(TextureKind::two_d, TexelFormat::rgba32ui, {3, 2});
  const TexelView texels = memory.level(0);
  for (uint32_t i = 0; i < 6; ++i) {
    const uint32_t codes[] = {0xfffffff0u + i, i, 0x01000001u + i, 7};  // more bits than a float has
    std::memcpy(texels.at(static_cast<int>(i % 3), static_cast<int>(i / 3)), codes, sizeof codes);
  }
  const Texture2DView view = memory.view<TextureKind::two_d>();
  const auto expect_column = [&](int component, int column, const ivec4<float>& four) {
    const auto code = [&](int x, int y) { return view.fetch_integers<float>(ivec3<float>(x, y, 0))[component]; };
    const int expected[] = {code(column, 1), code(column + 1, 1), code(column + 1, 0), code(column, 0)};
    for (int k = 0; k < 4; ++k) EXPECT_EQ(four[k], expected[k]) << component;
  };
  const vec2<float> left(0.4f, 0.5f), right(0.6f, 0.5f);  // between the columns 0 and 1, and 1 and 2
  for (int component = 0; component < 4; ++component) {
    expect_column(component, 0, view.gather_integers(Sampler{}, left, component));
    expect_column(component, 1, view.gather_integers(Sampler{}, left, component, glm::ivec3(1, 0, 0)));
    expect_column(component, 1, view.gather_integers(Sampler{}, right, component));
  }
  EXPECT_EQ(static_cast<uint32_t>(view.gather_integers(Sampler{}, right, 0).x), 0xfffffff4u);
  EXPECT_EQ(view.gather_integers(Sampler{}, right, 2).w, 0x01000002);
}

TEST(TextureGather, KeepsItsOrderWhereTheImageIsMirrored) {
  TextureMemory memory(TextureKind::two_d, TexelFormat::r32f, {4, 4});
  for (int i = 0; i < 16; ++i) memory.set(i % 4, i / 4, 0, 0, glm::vec4(static_cast<float>(i)));
  const Texture2DView view = memory.view<TextureKind::two_d>();
  const auto gather = [&](Wrap s, Wrap t, float x, float y, const glm::ivec3& offset = glm::ivec3(0)) {  // in texels
    return glm::vec4(view.gather(Sampler{.wrap_s = s, .wrap_t = t}, vec2<float>(x / 4, y / 4), 0, offset));
  };
  // Texels of a row and their mirror images: ... 1 0 | 0 1 2 3 | 3 2 ...
  EXPECT_EQ(gather(Wrap::mirrored, Wrap::clamp, 5.25f, 1.25f), glm::vec4(7, 6, 2, 3));   // columns 4 and 5 are 3 and 2
  EXPECT_EQ(gather(Wrap::mirrored, Wrap::clamp, -1.25f, 1.25f), glm::vec4(5, 4, 0, 1));  // columns −2 and −1 are 1 and 0
  EXPECT_EQ(gather(Wrap::clamp, Wrap::mirrored, 1.25f, 5.25f), glm::vec4(8, 9, 13, 12));
  EXPECT_EQ(gather(Wrap::mirrored_clamp, Wrap::clamp, -2.25f, 1.25f), glm::vec4(6, 5, 1, 2));
  EXPECT_EQ(gather(Wrap::mirrored, Wrap::clamp, 3.25f, 1.25f, glm::ivec3(2, 0, 0)), glm::vec4(7, 6, 2, 3));
}

TEST(TextureOffset, MovesByWholeTexelsBeforeWrapping) {
  const auto memory = noise<TextureKind::two_d>(TexelFormat::rgba8, {8, 4}, 2);
  const Texture2DView view = memory->view<TextureKind::two_d>();
  for (const Wrap wrap : test::kWraps) {
    const Sampler sampler{.wrap_s = wrap, .wrap_t = wrap};
    for (const int level : {0, 1}) {
      const auto w = static_cast<float>(view.width(level)), h = static_cast<float>(view.height(level));
      for (const glm::ivec3 offset : {glm::ivec3(1, 0, 0), glm::ivec3(-8, 3, 0), glm::ivec3(7, -5, 0)}) {
        const vec2<float> uv(1.5f / w, 0.5f / h);
        const vec2<float> moved(uv.x + static_cast<float>(offset.x) / w, uv.y + static_cast<float>(offset.y) / h);
        EXPECT_TRUE(same_bits(view.sample_level(sampler, uv, static_cast<float>(level), offset),
                              view.sample_level(sampler, moved, static_cast<float>(level))));
      }
    }
  }
}

TEST(TextureViews, ProjectedLookupsDivideCoordinatesAndDerivatives) {
  const auto memory = numbered_levels(64);
  const Texture2DView view = memory->view<TextureKind::two_d>();
  // d(p/q)/dx = (dp − (p/q)·dq)/q: (0.25 − 0.25·0.5)/2 is 4 texels along s, and −0.25·0.5/2 is −4 texels along t.
  const float lod =
      view.sample_projected(Sampler{}, vec2<float>(0.5f, 0.5f), vec2<float>(0.25f, 0.0f), vec2<float>(0.0f), 2.0f, 0.5f, 0.0f).x;
  EXPECT_EQ(lod, 2.5f);
}

TEST(TextureViews, ProjectedComparisonsDivideTheReferenceToo) {
  TextureMemory memory(TextureKind::two_d, TexelFormat::d32f, {2, 2}, 2);
  for (int i = 0; i < 4; ++i) memory.set(i % 2, i / 2, 0, 0, glm::vec4(0.25f));
  memory.set(0, 0, 0, 1, glm::vec4(0.75f));
  const Texture2DView view = memory.view<TextureKind::two_d>();
  const vec2<float> p(1.0f, 1.0f), still(0.0f), whole(4.0f, 0.0f);  // with divisor 2, `whole` is 4 texels per pixel: level 1
  const Sampler sampler{.min = Filter::nearest_mipmap_nearest, .compare = CompareOp::less};
  const auto compare = [&](float reference, const vec2<float>& dx) {
    return view.sample_compare_projected(sampler, p, reference, dx, still, 2.0f, 0.0f, 0.0f);
  };
  EXPECT_EQ(compare(0.4f, still), 1.0f);  // 0.2 < 0.25
  EXPECT_EQ(compare(0.6f, still), 0.0f);  // 0.3 > 0.25
  EXPECT_EQ(compare(0.6f, whole), 1.0f);  // 0.3 < 0.75
  EXPECT_EQ(compare(1.6f, whole), 0.0f);
}

// ---- cubes ------------------------------------------------------------------------------------------------------------------------------

TEST(TextureCubes, FacesFollowTheTableOfOpenGl) {
  TextureMemory memory(TextureKind::cube, TexelFormat::r32f, {4, 4, 6});
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < 16; ++i) memory.set(i % 4, i / 4, face, 0, glm::vec4(static_cast<float>(16 * face + i)));
  }
  const TextureCubeView view = memory.view<TextureKind::cube>();
  const Sampler nearest{.mag = Filter::nearest, .min = Filter::nearest};
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < 16; ++i) {
      const glm::dvec3 d = cube_direction(face, (2 * (i % 4) + 1) / 4.0 - 1, (2 * (i / 4) + 1) / 4.0 - 1);
      const vec3<float> direction(static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z));
      EXPECT_EQ(view.sample_level(nearest, direction, 0.0f).x, static_cast<float>(16 * face + i));
      EXPECT_EQ(view.sample_level(Sampler{}, direction * 3.0f, 0.0f).x, static_cast<float>(16 * face + i));  // at texel centers
    }
  }
}

// EnvironmentMap stores the neighbors of each edge, and rounds the mean of the three texels at a corner to a texel. Coordinates differ in
// rounding: it adds a border of one texel to each face.
TEST(TextureCubes, EdgesAndCornersMatchEnvironmentMap) {
  std::array<Image<glm::vec4>, 6> faces;
  TextureMemory memory(TextureKind::cube, TexelFormat::rgba32f, {5, 5, 6});
  std::mt19937 random(4);
  for (std::size_t f = 0; f < 6; ++f) {
    faces[f] = Image<glm::vec4>(5, 5);
    for (int i = 0; i < 25; ++i) {
      const glm::vec4 color(static_cast<float>(random() % 256), static_cast<float>(random() % 256), static_cast<float>(random() % 256),
                            1.0f);
      faces[f].at(i % 5, i / 5) = color;
      memory.set(i % 5, i / 5, static_cast<int>(f), 0, color);
    }
  }
  const EnvironmentMap map(std::span<const std::array<Image<glm::vec4>, 6>>(&faces, 1), TexelFormat::rgba32f);
  const TextureCubeView view = memory.view<TextureKind::cube>();
  std::uniform_real_distribution<float> number(-1.0f, 1.0f);
  for (int i = 0; i < 20000; ++i) {
    vec3<float> d(number(random), number(random), number(random));
    if (i % 2 == 0) d.y = std::copysign(std::abs(d.x) * (1.0f + 0.1f * number(random)), d.y);  // near an edge
    if (i % 4 == 0) d.z = std::copysign(std::abs(d.x) * (1.0f + 0.1f * number(random)), d.z);  // near a corner
    const vec3<float> expected = map.sample_level<float>(d, 0.0f);
    const vec4<float> color = view.sample_level(Sampler{}, d, 0.0f);
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(color[k], expected[k], 255 * 4.0 / 32768.0) << d.x << " " << d.y << " " << d.z;
  }
}

TEST(TextureCubes, ArraysSelectACube) {
  TextureMemory memory(TextureKind::cube_array, TexelFormat::r32f, {2, 2, 12});
  for (int layer = 0; layer < 12; ++layer) {
    for (int i = 0; i < 4; ++i) memory.set(i % 2, i / 2, layer, 0, glm::vec4(static_cast<float>(layer)));
  }
  const TextureCubeArrayView view = memory.view<TextureKind::cube_array>();
  for (int cube = 0; cube < 2; ++cube)
    EXPECT_EQ(view.sample_level(Sampler{}, vec4<float>(0.0f, 0.0f, -1.0f, static_cast<float>(cube)), 0.0f).x,
              static_cast<float>(6 * cube + 5));
}

// ---- memory -----------------------------------------------------------------------------------------------------------------------------

TEST(TextureViews, RowsInReverseFlipTheTexture) {
  Image<glm::u8vec4> image(3, 5);
  for (int i = 0; i < 15; ++i) image.at(i % 3, i / 3) = glm::u8vec4(static_cast<uint8_t>(i));
  const TexelView texels = texel_view(image, TexelFormat::rgba8ui);
  const Texture2DView top_first(texels), bottom_first(texels.flipped()), part(ConstTexelView(texels.part(1, 2, 2, 3)));
  for (int y = 0; y < 5; ++y) {
    EXPECT_EQ(top_first.fetch_integers<float>(ivec3<float>(1, y, 0)).x, 1 + 3 * y);
    EXPECT_EQ(bottom_first.fetch_integers<float>(ivec3<float>(1, y, 0)).x, 1 + 3 * (4 - y));
  }
  EXPECT_EQ(part.height(), 3);
  EXPECT_EQ(part.fetch_integers<float>(ivec3<float>(0, 0, 0)).x, 7);
}

TEST(TextureViews, AllInputsAreSafe) {
  const auto memory = noise<TextureKind::three_d>(TexelFormat::rgb8, {5, 3, 2}, 2);
  const Texture3DView view = memory->view<TextureKind::three_d>();
  for (const float bad : {NAN, INFINITY, -INFINITY, 3e38f, -3e38f}) {
    for (const Wrap wrap : test::kWraps) {
      const Sampler sampler{.wrap_s = wrap, .wrap_t = wrap, .wrap_r = wrap};
      const vec3<float> p(bad), d(bad);
      const vec4<float> color = view.sample(sampler, p, d, d);
      for (int k = 0; k < 4; ++k) EXPECT_TRUE(color[k] >= 0.0f && color[k] <= 1.0f);
    }
  }
  const auto cube = noise<TextureKind::cube>(TexelFormat::r8, {3, 3, 6});
  for (const float bad : {0.0f, NAN, INFINITY}) {
    const vec4<float> color = cube->view<TextureKind::cube>().sample(Sampler{}, vec3<float>(bad), vec3<float>(bad), vec3<float>(bad));
    EXPECT_TRUE(color.x >= 0.0f && color.x <= 1.0f);
  }
  for (const ivec3<float> outside : {ivec3<float>(-1, 0, 0), ivec3<float>(5, 0, 0), ivec3<float>(0, 3, 0), ivec3<float>(0, 0, 2)})
    EXPECT_EQ(glm::vec4(view.fetch<float>(outside)), glm::vec4(0.0f));
  EXPECT_EQ(glm::vec4(view.fetch<float>(ivec3<float>(0), 2)), glm::vec4(0.0f));
}

TEST(TextureMemories, MipmapsEqualThoseOfTexture2D) {
  for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::srgb8a8, TexelFormat::r8, TexelFormat::r16}) {
    const Texture2D expected = test::make_noise(16, 8, format, 9);
    TextureMemory memory(TextureKind::two_d, format, {16, 8}, expected.levels());
    for (int i = 0; i < 128; ++i) memory.set(i % 16, i / 16, 0, 0, expected.value(0, i % 16, i / 16));
    memory.generate_mipmaps();
    const Texture2DView view = memory.view<TextureKind::two_d>();
    for (int k = 0; k < expected.levels(); ++k) {
      for (int y = 0; y < expected.height(k); ++y) {
        for (int x = 0; x < expected.width(k); ++x)
          ASSERT_EQ(glm::vec4(view.fetch<float>(ivec3<float>(x, y, 0), k)), expected.value(k, x, y)) << texel_info(format).name;
      }
    }
  }
}

TEST(TextureMemories, MipmapsAverageEveryFormatAndKind) {
  for (const TexelFormat format : real_formats()) {
    if (has_stencil(format)) continue;
    TextureMemory memory(TextureKind::three_d, format, {2, 2, 2}, 2);
    for (int i = 0; i < 8; ++i) memory.set(i % 2, i / 2 % 2, i / 4, 0, glm::vec4(i == 0 ? 1.0f : 0.0f));
    memory.generate_mipmaps();
    // The nearest code to 1/8; linear sRGB has the steepest codes of 8 bits and more.
    const glm::vec4 mean = memory.view<TextureKind::three_d>().fetch<float>(ivec3<float>(0), 1);
    const bool is_small = texel_info(format).kind == TexelKind::unorm && channel_bits(format, 0) < 8;
    const float half_step = is_small ? 0.501f / static_cast<float>((1 << channel_bits(format, 0)) - 1) : 0.004f;
    EXPECT_NEAR(mean.x, 0.125f, half_step) << texel_info(format).name;
  }
  TextureMemory cube(TextureKind::cube, TexelFormat::rg16f, {4, 4, 6}, 3);
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < 16; ++i) cube.set(i % 4, i / 4, face, 0, glm::vec4(static_cast<float>(face), static_cast<float>(i), 0.0f, 0.0f));
  }
  cube.generate_mipmaps();
  for (int face = 0; face < 6; ++face)
    EXPECT_EQ(glm::vec4(cube.view<TextureKind::cube>().fetch<float>(ivec3<float>(0, 0, face), 2)),
              glm::vec4(static_cast<float>(face), 7.5f, 0, 1));
}

TEST(TextureMemories, MipmapsHaveTheSameBitsForAnyNumberOfThreads) {
  const TextureSize size{37, 22, 5};
  TextureMemory one(TextureKind::three_d, TexelFormat::rgba16, size, 6), four(TextureKind::three_d, TexelFormat::rgba16, size, 6);
  fill_with_noise(one.level(), 3);
  fill_with_noise(four.level(), 3);
  one.generate_mipmaps();
  const Workers workers(4);
  four.generate_mipmaps(&workers);
  for (int k = 0; k < one.levels(); ++k) {
    const TexelView a = one.level(k), b = four.level(k);
    EXPECT_EQ(std::memcmp(a.data, b.data, static_cast<std::size_t>(a.layers * a.layer_pitch)), 0) << k;
  }
}

TEST(TextureViewsDeathTest, RefuseLevelsThatDoNotFit) {
  Image<glm::u8vec4> four(4, 4), three(3, 2);
  const ConstTexelView big = texel_view(four, TexelFormat::rgba8), small = texel_view(three, TexelFormat::rgba8);
  const ConstTexelView levels[] = {big, small};
  EXPECT_DEATH(Texture2DView(std::span<const ConstTexelView>(levels)), "a level has the wrong size; expected half of the level before");
  EXPECT_DEATH((TextureCubeView(big)), "expected six squares");
  ConstTexelView odd = big;
  odd.data += 1;
  EXPECT_DEATH((Texture2DView(odd)), "texels are not aligned");
  ConstTexelView narrow = big;
  narrow.row_pitch = 12;
  EXPECT_DEATH((Texture2DView(narrow)), "rows overlap");
  EXPECT_DEATH((TextureMemory(TextureKind::two_d, TexelFormat::rgba8, {0, 4})), "expected sizes of at least 1");
  EXPECT_DEATH((TextureMemory(TextureKind::two_d, TexelFormat::rgba8, {4, 4}, 4)), "too few or too many levels");
}

}  // namespace
}  // namespace texture_views
}  // namespace halfspace
