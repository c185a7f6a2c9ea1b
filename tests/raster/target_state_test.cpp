// SPDX-License-Identifier: Apache-2.0
//
// State of attachments and samples: logic operations, alpha to one, sample coverage, a state for each of twelve attachments, clears in the
// middle of a pass, and depth and stencil that are loaded apart.
#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "halfspace/core/texel_codec.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test::target_state {
namespace {

constexpr int kEdge = 70;  // tiles at the right and upper border are partial

const std::vector<glm::vec4>& everywhere() {
  static const std::vector<glm::vec4> positions = full_screen();
  return positions;
}
VertexView whole_target() { return make_vertex_view(stream(everywhere())); }

template <class Pixel>
bool all_are(const Image<Pixel>& image, const Pixel& value) {
  return std::ranges::all_of(image.texels(), [&](const Pixel& p) { return p == value; });
}

// Table 17.3 of OpenGL 4.6, for source 1100 and destination 1010.
constexpr std::array<uint8_t, 16> kLogicResults{0b0000, 0b1000, 0b0100, 0b1100, 0b0010, 0b1010, 0b0110, 0b1110,
                                                0b0001, 0b1001, 0b0101, 0b1101, 0b0011, 0b1011, 0b0111, 0b1111};

TEST(LogicOps, CombineTheCodesOfNormalizedValues) {
  for (unsigned op = 0; op < 16; ++op) {
    for (const ColorMask mask : {ColorMask{}, ColorMask{true, false, true, false}}) {
      Image<glm::u8vec4> image(kEdge, kEdge);
      const float source = 0b11001100 / 255.0f, destination = 0b10101010 / 255.0f;
      ColorTarget target = rgba8_target(image);
      target.clear_value = glm::vec4(destination);
      Pass pass(kEdge, kEdge, target, {});
      pass.draw(ConstantShader{glm::vec4(source)}, whole_target(), {.color_mask = mask, .logic_op = static_cast<LogicOp>(op)});
      pass.run(one_worker());
      const auto result = static_cast<uint8_t>(kLogicResults[op] * 0b10001);
      const glm::u8vec4 expected(result, mask.g ? result : 0b10101010, result, mask.a ? result : 0b10101010);
      EXPECT_TRUE(all_are(image, expected)) << op;
    }
  }
}

TEST(LogicOps, CombineIntegersAndPackedCodes) {
  for (unsigned op = 0; op < 16; ++op) {
    const auto combined = [&](uint32_t bits) {
      uint32_t result = 0;
      for (uint32_t shift = 0; shift < bits; shift += 4) result |= uint32_t{kLogicResults[op]} << shift;
      return bits == 32 ? result : result & ((1u << bits) - 1);
    };
    const auto draw = [&](auto& image, ColorFormat format, const auto& shader, const glm::vec4& destination) {
      ColorTarget target = color_target(format, image);
      target.clear_value = destination;
      Pass pass(kEdge, kEdge, target, {});
      pass.draw(shader, whole_target(), {.logic_op = static_cast<LogicOp>(op)});
      pass.run(one_worker());
    };
    const auto bits = [](int32_t x) { return std::bit_cast<glm::vec4>(glm::ivec4(x)); };
    const auto unsigned_integers = [](int32_t x) { return ConstantIntegers<uvec4>(glm::ivec4(x)); };
    Image<uint32_t> words(kEdge, kEdge);
    draw(words, ColorFormat::r32ui, unsigned_integers(static_cast<int32_t>(0xcccccccc)), bits(static_cast<int32_t>(0xaaaaaaaa)));
    EXPECT_TRUE(all_are(words, combined(32))) << op;
    Image<uint16_t> shorts(kEdge, kEdge);
    draw(shorts, ColorFormat::r16ui, unsigned_integers(0xcccc), bits(0xaaaa));
    EXPECT_TRUE(all_are(shorts, static_cast<uint16_t>(combined(16)))) << op;
    Image<int8_t> bytes(kEdge, kEdge);
    draw(bytes, ColorFormat::r8i, ConstantIntegers<ivec4>(glm::ivec4(static_cast<int8_t>(0xcc))), bits(static_cast<int8_t>(0xaa)));
    EXPECT_TRUE(all_are(bytes, static_cast<int8_t>(combined(8)))) << op;
    draw(words, ColorFormat::rgb10_a2, ConstantShader{glm::vec4(glm::vec3(0b1011001100 / 1023.0f), 2.0f / 3.0f)},
         glm::vec4(glm::vec3(0b1010101010 / 1023.0f), 2.0f / 3.0f));
    const auto channel = [&](uint32_t s, uint32_t d) {
      uint32_t result = 0;
      for (uint32_t bit = 0; bit < 10; ++bit) {
        const uint32_t pair = ((s >> bit & 1) << 1) | (d >> bit & 1);  // the bit of the table: 11, 10, 01, 00 from the left
        result |= (uint32_t{kLogicResults[op]} >> pair & 1) << bit;
      }
      return result;
    };
    const uint32_t ten = channel(0b1011001100, 0b1010101010), two = channel(0b10, 0b10) & 3;
    EXPECT_TRUE(all_are(words, ten | ten << 10 | ten << 20 | two << 30)) << op;
  }
}

TEST(LogicOpsDeathTest, StateWithoutEffectIsRefused) {
  Image<glm::u8vec4> image(kEdge, kEdge);
  Image<glm::vec4> floats(kEdge, kEdge);
  Pass encoded(kEdge, kEdge, srgb8a8_target(image), {}), light(kEdge, kEdge, rgba32f_target(floats), {}),
      linear(kEdge, kEdge, rgba8_target(image), {});
  const DrawState state{.logic_op = LogicOp::bit_xor};
  EXPECT_DEATH(encoded.draw(ConstantShader{}, whole_target(), state), "logic_op applies to a target of floats");
  EXPECT_DEATH(light.draw(ConstantShader{}, whole_target(), state), "logic_op applies to a target of floats");
  DrawState blended = state;
  blended.blend = kAdd;
  EXPECT_DEATH(linear.draw(ConstantShader{}, whole_target(), blended), "logic_op is combined with blending");
  DrawState covered;
  covered.sample_coverage = SampleCoverage{1.5f};
  EXPECT_DEATH(linear.draw(ConstantShader{}, whole_target(), covered), "sample_coverage: the value is outside");
}

TEST(Samples, AlphaToOneFollowsAlphaToCoverage) {
  for (const int samples : {1, 4}) {
    Image<glm::vec4> image(kEdge, kEdge);
    Pass pass(kEdge, kEdge, rgba32f_target(image), {}, {.samples = samples});
    pass.draw(ConstantShader{glm::vec4(1.0f, 1.0f, 1.0f, 0.5f)}, whole_target(), {.alpha_to_coverage = true, .alpha_to_one = true});
    pass.run(one_worker());
    // Two of four samples have alpha 1. With one sample, the state has no effect.
    EXPECT_TRUE(all_are(image, samples == 1 ? glm::vec4(1, 1, 1, 0.5f) : glm::vec4(0.5f))) << samples;
  }
  Image<uint32_t> integers(kEdge, kEdge);
  Pass pass(kEdge, kEdge, r32ui_target(integers), {}, {.samples = 4});
  pass.draw(ConstantIntegers<uvec4>{glm::ivec4(7)}, whole_target(), {.alpha_to_one = true});
  pass.run(one_worker());
  EXPECT_TRUE(all_are(integers, 7u));
}

TEST(Samples, CoverageSelectsTheFirstSamples) {
  for (const int samples : {1, 2, 4, 8}) {
    for (const bool invert : {false, true}) {
      for (int eighths = 0; eighths <= 8; ++eighths) {
        Image<glm::vec4> image(kEdge, kEdge);
        Pass pass(kEdge, kEdge, rgba32f_target(image), {}, {.samples = samples});
        pass.draw(ConstantShader{glm::vec4(1.0f)}, whole_target(),
                  {.sample_coverage = SampleCoverage{static_cast<float>(eighths) / 8.0f, invert}});
        pass.run(one_worker());
        const int covered = (eighths * samples + 4) / 8;
        const float share = static_cast<float>(invert ? samples - covered : covered) / static_cast<float>(samples);
        EXPECT_TRUE(all_are(image, glm::vec4(samples == 1 ? 1.0f : share))) << samples << ' ' << invert << ' ' << eighths;
      }
    }
  }
}

struct AllTargetsShader : PositionShader {
  template <class R>
  FragmentMRT<R, kMaxColorTargets> fragment(const Varyings<R>&, const Pixel<R>&) const {
    FragmentMRT<R, kMaxColorTargets> out;
    for (std::size_t n = 0; n < out.color.size(); ++n) out.color[n] = vec4<R>(R(static_cast<float>(n) + 1.0f));
    return out;
  }
};

TEST(AttachmentStates, AreOwnForAllTwelve) {
  std::vector<Image<glm::vec4>> images(kMaxColorTargets, Image<glm::vec4>(kEdge, kEdge));
  std::vector<ColorTarget> targets;
  for (Image<glm::vec4>& image : images) {
    targets.push_back(rgba32f_target(image));
    targets.back().clear_value = glm::vec4(100.0f);
  }
  DrawState state;
  state.blend = kAdd;
  for (std::size_t n = 0; n < images.size(); ++n) {
    if (n % 3 == 1) state.attachments[n] = AttachmentState{};  // replaces
    if (n % 3 == 2) state.attachments[n] = AttachmentState{.blend = kAdd, .mask = {false, true, false, true}};
  }
  Pass pass(kEdge, kEdge, targets, {});
  pass.draw(AllTargetsShader{}, whole_target(), state);
  pass.run(one_worker());
  for (std::size_t n = 0; n < images.size(); ++n) {
    const float value = static_cast<float>(n) + 1.0f, sum = 100.0f + value;
    const glm::vec4 expected = n % 3 == 0 ? glm::vec4(sum) : n % 3 == 1 ? glm::vec4(value) : glm::vec4(100.0f, sum, 100.0f, sum);
    EXPECT_TRUE(all_are(images[n], expected)) << n;
  }
}

// A clear has its place among the draws, and keeps what it does not name.
TEST(Clears, SetAPartOfTheTarget) {
  Image<glm::vec4> color(kEdge, kEdge), other(kEdge, kEdge);
  Image<uint32_t> depth(kEdge, kEdge);
  DepthTarget depth_target = d24s8_target(depth);
  depth_target.stencil_clear_value = 0x0f;
  const std::array targets{rgba32f_target(color), rgba32f_target(other)};
  Pass pass(kEdge, kEdge, targets, depth_target);
  pass.draw(AllTargetsShader{}, whole_target(), {.depth = {.compare = CompareOp::always}});
  pass.clear({.rect = Rect{10, 20, 30, 40}, .colors = {glm::vec4(9.0f)}, .mask = {true, true, false, true}});
  pass.clear({.rect = Rect{0, 0, 10, 10}, .depth = 0.25f});
  pass.clear({.rect = Rect{60, 0, 100, 100}, .stencil = uint8_t{0xaa}, .stencil_mask = 0xf0});
  pass.draw(AllTargetsShader{}, whole_target(), {.scissor = Rect{0, 0, 15, 25}, .depth = {.test = false}});  // over the first clear
  pass.run(one_worker());
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) {
      const bool is_cleared = x >= 10 && x < 40 && y >= 20 && y < 60 && !(x < 15 && y < 25);
      ASSERT_EQ(pixel(color, x, y), is_cleared ? glm::vec4(9, 9, 1, 9) : glm::vec4(1.0f)) << x << ' ' << y;
      ASSERT_EQ(pixel(other, x, y), glm::vec4(2.0f));
      const uint32_t code = x < 10 && y < 10 ? 4194304u : 8388608u;  // 0.25 and 0.5, times 2^24 − 1, rounded to even
      ASSERT_EQ(pixel(depth, x, y), code << 8 | (x >= 60 ? 0xafu : 0x0fu)) << x << ' ' << y;
    }
  }
}

TEST(Clears, WorkWithoutColorsAndWithIntegers) {
  Image<float> depth(kEdge, kEdge);
  Pass only_depth(kEdge, kEdge, std::span<const ColorTarget>(), d32f_target(depth));
  only_depth.clear({.rect = Rect{0, 0, kEdge, 7}, .depth = 0.3f});
  only_depth.run(one_worker());
  for (int y = 0; y < kEdge; ++y) EXPECT_EQ(pixel(depth, 5, y), y < 7 ? 0.3f : 1.0f);
  Image<uint32_t> integers(kEdge, kEdge);
  Pass pass(kEdge, kEdge, r32ui_target(integers), {}, {.samples = 4});
  pass.clear({.colors = {std::bit_cast<glm::vec4>(glm::ivec4(-5))}});
  pass.run(one_worker());
  EXPECT_TRUE(all_are(integers, 0xfffffffbu));
}

// These are the bits of a signaling NaN.
TEST(Clears, KeepTheBitsOfIntegers) {
  constexpr uint32_t kBits = 0x7f800001;
  for (const int samples : {1, 4}) {
    for (const int kind : {0, 1, 2}) {  // without a tile, in a tile, and between draws
      Image<uint32_t> integers(kEdge, kEdge);
      Pass pass(kEdge, kEdge, r32ui_target(integers, kind == 2 ? 0 : kBits), {}, {.samples = samples});
      if (kind == 1) pass.clear({.rect = Rect{0, 0, 0, 0}, .colors = {glm::vec4(0.0f)}});
      if (kind == 2) pass.clear({.colors = {glm::vec4(std::bit_cast<float>(kBits))}});
      pass.run(one_worker());
      EXPECT_TRUE(all_are(integers, kBits)) << samples << kind;
    }
  }
}

TEST(LoadStore, DepthAndStencilAreLoadedApart) {
  for (const bool draws : {false, true}) {
    for (const bool loads_depth : {false, true}) {
      Image<DepthStencil> image(kEdge, kEdge);
      std::fill_n(image.data(), kEdge * kEdge, DepthStencil{0.25f, 7});
      DepthTarget target = d32fs8_target(image);
      target.load = loads_depth ? LoadOp::load : LoadOp::clear;
      target.stencil_load = loads_depth ? LoadOp::clear : LoadOp::load;
      target.clear_value = 0.75f;
      target.stencil_clear_value = 9;
      Pass pass(kEdge, kEdge, ColorTarget{}, target);
      if (draws) pass.draw_depth(PositionShader{}, whole_target(), {.scissor = Rect{0, 0, 1, 1}, .depth = {.compare = CompareOp::never}});
      pass.run(one_worker());
      EXPECT_TRUE(all_are(image, loads_depth ? DepthStencil{0.25f, 9} : DepthStencil{0.75f, 7})) << draws << loads_depth;
    }
  }
}

TEST(LoadStore, DepthAndStencilAreStoredApart) {
  const StencilFace sets{.pass = StencilOp::replace, .reference = 9};
  for (const bool draws : {false, true}) {
    for (const bool stores_depth : {false, true}) {
      Image<DepthStencil> image(kEdge, kEdge);
      std::fill_n(image.data(), kEdge * kEdge, DepthStencil{0.25f, 7});
      DepthTarget target = d32fs8_target(image);
      target.store = stores_depth ? StoreOp::store : StoreOp::dont_care;
      target.stencil_store = stores_depth ? StoreOp::dont_care : StoreOp::store;
      target.clear_value = 0.75f;
      target.stencil_clear_value = draws ? 3 : 9;
      Pass pass(kEdge, kEdge, ColorTarget{}, target);
      if (draws) pass.draw_depth(PositionShader{}, whole_target(), {.stencil = StencilState{sets, sets}});  // at depth 1/2
      pass.run(one_worker());
      // The other part of the image is undefined.
      for (const DepthStencil& texel : image.texels()) {
        const bool is_stored_part_right = stores_depth ? texel.depth == (draws ? 0.5f : 0.75f) : texel.stencil == 9;
        ASSERT_TRUE(is_stored_part_right) << draws << stores_depth << ": " << texel.depth << ' ' << texel.stencil;
      }
    }
  }
}

TEST(LoadStore, TheUnusedBitsOfDepthsAreIgnored) {
  Image<uint32_t> depths(kEdge, kEdge);
  std::fill_n(depths.data(), kEdge * kEdge, 0xff000001u);  // code 1, nearer than the quad at depth 1/2
  Image<glm::u8vec4> image(kEdge, kEdge);
  DepthTarget target = d24_target(depths);
  target.load = LoadOp::load;
  Pass pass(kEdge, kEdge, rgba8_target(image), target);
  pass.draw(ConstantShader{glm::vec4(1.0f)}, whole_target());
  pass.run(one_worker());
  EXPECT_TRUE(all_are(image, glm::u8vec4(0)));
}

}  // namespace
}  // namespace halfspace::raster_test::target_state
