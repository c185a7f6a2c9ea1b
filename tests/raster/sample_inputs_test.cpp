// SPDX-License-Identifier: Apache-2.0
//
// Tests what fragment functions know of samples (their number, position and mask, values at other samples and offsets), and sample masks
// that they return.
#include <bit>

#include "halfspace/raster/sample_location.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test::sample_inputs_test {
namespace {

constexpr int kSize = 16;

// Replaces the color, but as blending, so that fragments are queued and shaded in order.
constexpr BlendState kReplace{.source_color = BlendFactor::one,
                              .destination_color = BlendFactor::zero,
                              .source_alpha = BlendFactor::one,
                              .destination_alpha = BlendFactor::zero};

PassStatistics draw(Image<glm::vec4>& image, const auto& shader, const std::vector<glm::vec4>& positions, const DrawState& state,
                    int samples) {
  Pass pass(image.width(), image.height(), rgba32f_target(image), {}, {.samples = samples});
  pass.draw(shader, make_vertex_view(stream(positions)), state);
  return pass.run(two_workers());
}

// A triangle of which no edge contains a sample: its coordinates are odd multiples of 1/512 px plus multiples of 1/8 px.
std::vector<glm::vec4> random_triangles(uint64_t seed, int count) {
  Random random(seed);
  std::vector<glm::vec4> p;
  for (int i = 0; i < 3 * count; ++i) {
    const auto at = [&] { return random.integer(-8, 136) * 32 + 2 * random.integer(0, 15) + 1; };
    p.push_back(clip_position({at(), at()}, kSize, kSize));
  }
  return p;
}

// Returns the samples of a pixel that a triangle covers.
uint32_t covered_samples(const glm::vec4* corner, int x, int y, int samples) {
  uint32_t mask = 0;
  for (int s = 0; s < samples; ++s) {
    const glm::dvec2 at = glm::dvec2(x, y) + glm::dvec2(sample_location(samples, s));
    int left = 0, right = 0;
    for (int i = 0; i < 3; ++i) {
      const auto window = [&](int k) { return (glm::dvec2(corner[k % 3]) + 1.0) * (kSize / 2.0); };
      const glm::dvec2 a = window(i), b = window(i + 1);
      const double side = (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
      (side > 0 ? left : right) += 1;
    }
    if (left == 3 || right == 3) mask |= 1u << s;
  }
  return mask;
}

struct NumberShader : PositionShader {
  static constexpr bool per_sample = true;
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    const vec2<R> at = px.sample_position();
    return {vec4<R>(R(static_cast<float>(px.sample)), R(static_cast<float>(px.samples)), at.x, at.y)};
  }
};

TEST(SampleInputs, NumberAndPositionAreThoseOfTheSample) {
  for (const int samples : {1, 2, 4, 8}) {
    for (int s = 0; s < samples; ++s) {
      for (const bool blends : {false, true}) {
        Image<glm::vec4> image(kSize, kSize);
        DrawState state{.sample_mask = 1u << s};
        if (blends) state.blend = kReplace;
        draw(image, NumberShader{}, full_screen(), state, samples);
        const glm::vec2 at = sample_location(samples, s);
        const glm::vec4 expected = glm::vec4(s, samples, at) / static_cast<float>(samples);
        for (int i = 0; i < kSize * kSize; ++i) ASSERT_EQ(image.data()[i], expected) << samples << " samples, number " << s;
      }
    }
  }
}

// A value that differs between the samples of a pixel, in perspective.
template <template <class> class Wrap>
struct ValueShader : PositionShader {
  template <class R>
  struct Varyings {
    Wrap<R> value;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.value.value = in.position.x * R(3) - in.position.y;
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.value.value, R(0), R(0), R(1))};
  }
};
struct SmoothShader : PositionShader {
  template <class R>
  struct Varyings {
    R value;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.value = in.position.x * R(3) - in.position.y;
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.value, R(0), R(0), R(1))};
  }
};

TEST(SampleInputs, VaryingsPerSampleAreSmoothVaryingsWithSampleShading) {
  std::vector<glm::vec4> p = random_triangles(3, 20);
  for (std::size_t i = 0; i < p.size(); ++i) p[i] *= static_cast<float>(1 + i % 3);
  for (const int samples : {1, 2, 4, 8}) {
    Image<glm::vec4> image(kSize, kSize), expected(kSize, kSize), by_pixel(kSize, kSize);
    const PassStatistics s = draw(image, ValueShader<PerSample>{}, p, {}, samples);
    const PassStatistics t = draw(expected, SmoothShader{}, p, {.sample_shading = true}, samples);
    draw(by_pixel, SmoothShader{}, p, {}, samples);
    EXPECT_EQ(image, expected);
    EXPECT_EQ(s, t);
    EXPECT_EQ(image == by_pixel, samples == 1);
  }
}

// The value is linear in the window, so its value anywhere is known.
struct ElsewhereShader : PositionShader {
  int sample = 0;
  glm::vec2 offset{0.0f};
  template <class R>
  struct Varyings {
    NoPerspective<vec2<R>> ndc;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.ndc.value = vec2<R>(in.position.x, in.position.y);
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    const vec2<R> at_sample = px.template at_sample<Varyings<R>>(sample).ndc.value;
    const vec2<R> at_offset = px.template at_offset<Varyings<R>>({R(offset.x), R(offset.y)}).ndc.value;
    return {vec4<R>(at_sample.x, at_sample.y, at_offset.x, at_offset.y)};
  }
};

TEST(SampleInputs, ValuesAtSamplesAndOffsetsAreThoseOfThePlane) {
  for (const int samples : {1, 2, 4, 8}) {
    for (int s = 0; s < samples; ++s) {
      for (const bool per_sample : {false, true}) {
        Image<glm::vec4> image(kSize, kSize);
        const ElsewhereShader shader{{}, s, {-0.4375f, 0.25f}};
        draw(image, shader, full_screen(), {.sample_shading = per_sample}, samples);
        for (int y = 0; y < kSize; ++y) {
          for (int x = 0; x < kSize; ++x) {
            const glm::vec2 corner(x, y);
            const glm::vec2 at_sample = (corner + sample_location(samples, s)) / 8.0f - 1.0f;
            const glm::vec2 at_offset = (corner + 0.5f + shader.offset) / 8.0f - 1.0f;
            for (int k = 0; k < 2; ++k) {  // the error of the interpolation is below 3e-7 of the largest value, which is 3
              EXPECT_NEAR(pixel(image, x, y)[k], at_sample[k], 9e-7f);
              EXPECT_NEAR(pixel(image, x, y)[2 + k], at_offset[k], 9e-7f);
            }
          }
        }
      }
    }
  }
}

// Keeps samples in stripes that are narrower than a pixel.
struct Stripes : PositionShader {
  static constexpr bool per_sample = true;
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(R(1), R(1), R(1), R(1)), visibility(in, px).keep};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>&, const Pixel<R>& px) const {
    const R phase = px.x * R(1.7f);
    return {phase - floor(phase) < R(0.4f), R(0)};
  }
};

TEST(SampleInputs, DepthOnlyDrawsRunPerSampleToo) {
  const std::vector<glm::vec4> p = random_triangles(21, 3);
  for (const int samples : {2, 4, 8}) {
    Image<glm::vec4> image(kSize, kSize), expected(kSize, kSize);
    Pass pass(kSize, kSize, rgba32f_target(image), {.format = DepthFormat::d32f}, {.samples = samples}),
        plain(kSize, kSize, rgba32f_target(expected), {.format = DepthFormat::d32f}, {.samples = samples});
    pass.draw_depth(Stripes{}, make_vertex_view(stream(p)));
    pass.draw(ConstantShader{}, make_vertex_view(stream(p)), {.depth = {.compare = CompareOp::equal}});
    plain.draw(Stripes{}, make_vertex_view(stream(p)));
    pass.run(one_worker());
    plain.run(one_worker());
    EXPECT_EQ(image, expected);
  }
}

template <bool each_sample>
struct MaskShader : PositionShader {
  static constexpr bool per_sample = each_sample;
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(to_real<R>(px.sample_mask()), R(1), R(0), R(0))};
  }
};

// Each covered sample adds the mask of its pixel, or its own bit of it. All numbers are integers and divided by powers of two, so sums are
// exact.
TEST(SampleInputs, TheMaskHasTheSamplesThatTheTriangleCovers) {
  for (const int samples : {1, 2, 4, 8}) {
    for (uint64_t seed = 0; seed < 40; ++seed) {
      const std::vector<glm::vec4> p = random_triangles(100 + seed, 1);
      const uint32_t enabled = seed % 4 == 3 ? 0xaau : 0xffu;
      for (const bool blends : {false, true}) {
        DrawState state{.sample_mask = enabled};
        if (blends) state.blend = kAdd;
        Image<glm::vec4> by_pixel(kSize, kSize), by_sample(kSize, kSize);
        draw(by_pixel, MaskShader<false>{}, p, state, samples);
        draw(by_sample, MaskShader<true>{}, p, state, samples);
        for (int y = 0; y < kSize; ++y) {
          for (int x = 0; x < kSize; ++x) {
            const uint32_t mask = covered_samples(p.data(), x, y, samples) & (samples == 1 ? 1u : enabled);
            const auto covered = static_cast<float>(std::popcount(mask)), value = static_cast<float>(mask), n = static_cast<float>(samples);
            ASSERT_EQ(pixel(by_pixel, x, y), glm::vec4(value * covered / n, covered / n, 0, 0)) << samples << ' ' << seed;
            ASSERT_EQ(pixel(by_sample, x, y), glm::vec4(value / n, covered / n, 0, 0)) << samples << ' ' << seed;
          }
        }
      }
    }
  }
}

TEST(SampleInputs, TheMaskOfAPointHasItsSamples) {
  Image<glm::vec4> image(kSize, kSize);
  const std::vector<glm::vec4> center{clip_position({8 * 256 + 32, 8 * 256 + 32}, kSize, kSize)};
  draw(image, MaskShader<false>{}, center, {.topology = Topology::points, .point_size = 1.0f}, 4);
  // The square is [7.625, 8.625) in x and y. The samples are at (6, 2), (14, 6), (2, 10) and (10, 14) sixteenths.
  EXPECT_EQ(pixel(image, 8, 8).x, 1 / 4.0f);
  EXPECT_EQ(pixel(image, 7, 7).x, 8 / 4.0f);
  EXPECT_EQ(pixel(image, 7, 8).x, 2 / 4.0f);
  EXPECT_EQ(pixel(image, 8, 7).x, 4 / 4.0f);
}

// The mask that a shader chooses for a pixel.
template <class I>
auto chosen_mask(const I& x, const I& y) {
  return (x + y * I(3)) & I(0xff);
}

template <template <class> class Result>
struct MaskingShader : PositionShader {
  template <class R>
  SampleMasked<R, Result<R>> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    const IntOf<R> x = truncate_to_int(px.x), y = truncate_to_int(px.y);
    SampleMasked<R, Result<R>> out;
    out.color = vec4<R>(R(1), R(1), R(1), R(1));
    out.sample_mask = chosen_mask(x, y);
    if constexpr (requires { out.keep; }) out.keep = (x & IntOf<R>(1)) == IntOf<R>(0);
    if constexpr (requires { out.depth; }) out.depth = R(0.25f);
    return out;
  }
};

template <template <class> class Result>
void expect_masked() {
  const std::vector<glm::vec4> p = random_triangles(7, 1);
  constexpr bool discards = std::is_same_v<Result<float>, DiscardingFragment<float>> || std::is_same_v<Result<float>, DepthFragment<float>>;
  for (const int samples : {1, 2, 4, 8}) {
    for (const bool each_sample : {false, true}) {
      for (const bool blends : {false, true}) {
        DrawState state{.sample_shading = each_sample, .query = 0};
        if (blends) state.blend = kAdd;
        Image<glm::vec4> image(kSize, kSize);
        Image<float> depth(kSize, kSize);
        Pass pass(kSize, kSize, rgba32f_target(image), d32f_target(depth), {.samples = samples});
        pass.draw(MaskingShader<Result>{}, make_vertex_view(stream(p)), state);
        pass.draw(ConstantShader{{0, 1, 0, 0}}, make_vertex_view(stream(p)), {.depth = {.compare = CompareOp::greater}, .blend = kAdd});
        const PassStatistics s = pass.run(one_worker());
        uint64_t passed = 0;
        for (int y = 0; y < kSize; ++y) {
          for (int x = 0; x < kSize; ++x) {
            uint32_t drawn = covered_samples(p.data(), x, y, samples);
            if (samples > 1) drawn &= static_cast<uint32_t>(chosen_mask(x, y));
            if (discards && x % 2 != 0) drawn = 0;
            passed += static_cast<uint64_t>(std::popcount(drawn));
            const float share = static_cast<float>(std::popcount(drawn)) / static_cast<float>(samples);
            ASSERT_EQ(pixel(image, x, y).x, share) << samples << ' ' << each_sample << ' ' << x << ' ' << y;
          }
        }
        EXPECT_EQ(s.queries[0], passed);
      }
    }
  }
}

TEST(SampleMask, DrawsOnlyTheSamplesThatTheShaderChooses) {
  expect_masked<Fragment>();
  expect_masked<DiscardingFragment>();
  expect_masked<DepthFragment>();
}

// Depth is written for the chosen samples only: a draw behind shows at all others.
TEST(SampleMask, OtherSamplesKeepTheirDepth) {
  for (const int samples : {2, 4, 8}) {
    Image<glm::vec4> image(kSize, kSize);
    Image<float> depth(kSize, kSize);
    Pass pass(kSize, kSize, rgba32f_target(image), d32f_target(depth), {.samples = samples});
    const std::vector<glm::vec4> near = full_screen(-0.5f), far = full_screen(0.5f);
    pass.draw(MaskingShader<Fragment>{}, make_vertex_view(stream(near)), {});
    pass.draw(ConstantShader{{2, 0, 0, 1}}, make_vertex_view(stream(far)), {});
    pass.run(one_worker());
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const auto chosen = static_cast<float>(std::popcount(static_cast<uint32_t>(chosen_mask(x, y)) & ((1u << samples) - 1)));
        const auto n = static_cast<float>(samples);
        EXPECT_EQ(pixel(image, x, y).x, (chosen + 2 * (n - chosen)) / n);
      }
    }
  }
}

// Shading all samples gives at least as many values as any fraction asks for.
TEST(MinSampleShading, ShadesAllSamplesUnlessOneIsEnough) {
  for (const int samples : {1, 2, 4, 8}) {
    for (const float fraction : {0.0f, 0.125f, 0.126f, 0.25f, 0.5f, 0.51f, 1.0f}) {
      Image<glm::vec4> image(kSize, kSize);
      const PassStatistics s =
          draw(image, ConstantShader{}, full_screen(), {.sample_shading = true, .min_sample_shading = fraction}, samples);
      const bool all = fraction * static_cast<float>(samples) > 1.0f;
      EXPECT_EQ(s.fragments_shaded, static_cast<uint64_t>(kSize * kSize * (all ? samples : 1))) << samples << ' ' << fraction;
    }
  }
  Image<glm::vec4> image(kSize, kSize);
  EXPECT_DEATH(draw(image, ConstantShader{}, full_screen(), {.min_sample_shading = 1.5f}, 4), "min_sample_shading: is outside");
}

}  // namespace
}  // namespace halfspace::raster_test::sample_inputs_test
