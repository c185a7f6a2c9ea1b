// SPDX-License-Identifier: Apache-2.0
//
// Blending, resolve, tone mapping and store. Items are pixels.
#include "halfspace/shading/values/tone.h"
#include "stages/stage_pass.h"
#include "workloads/workload_constant.h"
#include "workloads/workload_tone.h"

namespace halfspace {

namespace {

const ConstantShader kHalfTransparent{{0.25f, 0.5f, 0.75f, 0.5f}};

// Draws a single-color quad over the cleared image.
void blend(benchmark::State& state, const std::optional<BlendState>& how) {
  DrawState draw_state;
  draw_state.blend = how;
  measure_draw(state, kStagePixels, kHalfTransparent, stage_quad_positions(), stage_quad_indices(), draw_state);
}
BENCHMARK_CAPTURE(blend, none, std::nullopt);
BENCHMARK_CAPTURE(blend, alpha, BlendState{});
BENCHMARK_CAPTURE(blend, add, (BlendState{.source_color = BlendFactor::one, .destination_color = BlendFactor::one}));
BENCHMARK_CAPTURE(blend, multiply, (BlendState{.source_color = BlendFactor::dst_color, .destination_color = BlendFactor::zero}));
BENCHMARK_CAPTURE(blend, max, BlendState{.color_equation = BlendEquation::max});

// Draws the same quad with 1 to 8 samples per pixel and resolves the samples.
void resolve(benchmark::State& state) {
  measure_draw(state, kStagePixels, kHalfTransparent, stage_quad_positions(), stage_quad_indices(), {},
               {.samples = static_cast<int>(state.range(0))});
}
BENCHMARK(resolve)->Arg(1)->Arg(2)->Arg(4)->Arg(8);

// Applies a post step to a half-float image that is cleared and not drawn to.
template <class Step>
void measure_post(benchmark::State& state, const Step& step, const ColorTarget& to) {
  Image<U16Vec4> light(kStageSize.width, kStageSize.height);
  ColorTarget from = rgba16f_target(light);
  from.clear_value = {0.4f, 0.6f, 1.5f, 1.0f};
  from.store = StoreOp::dont_care;
  measure_passes(state, kStagePixels, [&](const Workers& workers) {
    Pass pass(kStageSize.width, kStageSize.height, from, {});
    pass.post(step, to);
    pass.run(workers);
  });
}

struct CurveStep {
  ToneMapping tone;
  template <class R>
  vec4<R> operator()(const vec4<R>& light) const {
    return vec4<R>(tone_map(SceneLight<R>{vec3<R>(light)}, tone).rgb, R(1));
  }
};

// Applies a tone curve, followed by the exact sRGB encoding of the target.
void tone(benchmark::State& state, ToneCurve curve) {
  Image<glm::u8vec4> shown(kStageSize.width, kStageSize.height);
  measure_post(state, CurveStep{{.curve = curve}}, srgb8a8_target(shown));
}
BENCHMARK_CAPTURE(tone, none, ToneCurve::none);
BENCHMARK_CAPTURE(tone, reinhard, ToneCurve::reinhard);
BENCHMARK_CAPTURE(tone, reinhard_extended, ToneCurve::reinhard_extended);
BENCHMARK_CAPTURE(tone, exponential, ToneCurve::exponential);
BENCHMARK_CAPTURE(tone, aces, ToneCurve::aces);

// Applies the tone curve of the workloads, which contains a power function.
void tone_power(benchmark::State& state) {
  Image<glm::u8vec4> shown(kStageSize.width, kStageSize.height);
  measure_post(state, WorkloadTone{}, rgba8_target(shown));
}
BENCHMARK(tone_power);

// Measures the store alone: the pass clears its attachments and draws nothing.
void measure_clear(benchmark::State& state, const ColorTarget& color, const DepthTarget& depth) {
  measure_passes(state, kStagePixels, [&](const Workers& workers) {
    Pass pass(kStageSize.width, kStageSize.height, color, depth);
    pass.run(workers);
  });
  const int64_t bytes = bytes_per_pixel(color.format) + bytes_per_pixel(depth.format);
  state.SetBytesProcessed(state.iterations() * kStagePixels * bytes);
}

template <class Texel>
void store_color(benchmark::State& state, ColorTarget (*target)(Image<Texel>&)) {
  Image<Texel> image(kStageSize.width, kStageSize.height);
  measure_clear(state, target(image), {});
}
BENCHMARK_CAPTURE(store_color, rgba8, rgba8_target);
BENCHMARK_CAPTURE(store_color, srgb8a8, srgb8a8_target);
BENCHMARK_CAPTURE(store_color, rgba16f, rgba16f_target);
BENCHMARK_CAPTURE(store_color, rgba32f, rgba32f_target);

template <class Texel>
void store_depth(benchmark::State& state, DepthTarget (*target)(Image<Texel>&)) {
  Image<Texel> image(kStageSize.width, kStageSize.height);
  measure_clear(state, ColorTarget{}, target(image));
}
BENCHMARK_CAPTURE(store_depth, d16, d16_target);
BENCHMARK_CAPTURE(store_depth, d24, d24_target);
BENCHMARK_CAPTURE(store_depth, d32f, d32f_target);
BENCHMARK_CAPTURE(store_depth, d32fs8, d32fs8_target);

}  // namespace

}  // namespace halfspace

BENCHMARK_MAIN();
