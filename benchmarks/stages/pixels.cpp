// SPDX-License-Identifier: Apache-2.0
//
// Interpolation, fragment shaders and texture lookups. Items are pixels.
#include "halfspace/shading/environment/star_sky.h"
#include "halfspace/shading/surface/surface_shader.h"
#include "stages/stage_pass.h"
#include "workloads/sphere_camera.h"
#include "workloads/workload_constant.h"
#include "workloads/workload_floor.h"
#include "workloads/workload_layers.h"
#include "workloads/workload_shadow.h"
#include "workloads/workload_varyings.h"

namespace halfspace {

namespace {

// Draws a quad over the whole image that interpolates and adds N floats per pixel. N = 0 measures everything else: visibility, color and
// store.
template <int N>
void interpolation(benchmark::State& state) {
  measure_draw(state, kStagePixels, VaryingsShader<N>{glm::mat4(1.0f)}, stage_quad_positions(), stage_quad_indices());
}
BENCHMARK_TEMPLATE(interpolation, 0);
BENCHMARK_TEMPLATE(interpolation, 4);
BENCHMARK_TEMPLATE(interpolation, 8);
BENCHMARK_TEMPLATE(interpolation, 16);
BENCHMARK_TEMPLATE(interpolation, 32);

void shader_constant(benchmark::State& state) {
  measure_draw(state, kStagePixels, ConstantShader{kFillColor}, stage_quad_positions(), stage_quad_indices());
}
BENCHMARK(shader_constant);

void shader_layer(benchmark::State& state) {
  std::vector<LayerShader::Attributes<float>> quad;
  for (const SphereVertex& v : kStageQuad) quad.push_back({v.position, v.normal, {0.5f, 0.5f, 0.5f}});
  measure_draw(state, kStagePixels, LayerShader{glm::mat4(1.0f)}, make_vertex_view(stream(quad)), stage_quad_indices());
}
BENCHMARK(shader_layer);

template <class S>
void shader_sphere(benchmark::State& state) {
  WorkloadAssets assets;
  const std::shared_ptr<const Texture2D> map = assets.checker();
  const S shader{SphereUniforms{.clip_from_world = glm::mat4(1.0f), .texture = map.get()}};
  measure_draw(state, kStagePixels, shader, stage_quad(), stage_quad_indices());
}
BENCHMARK_TEMPLATE(shader_sphere, SpherePhong);
BENCHMARK_TEMPLATE(shader_sphere, SphereGouraud);
BENCHMARK_TEMPLATE(shader_sphere, SphereFlat);

void shader_shadowed(benchmark::State& state) {
  const std::vector<float> map(static_cast<std::size_t>(kShadowMapSize) * kShadowMapSize, 0.5f);
  const ShadowedShader shader{.clip_from_world = glm::mat4(1.0f),
                              .light_from_world = glm::mat4(1.0f),
                              .map = {map.data(), nullptr},
                              .eye_ws = {0, 0, 2},
                              .to_light_ws = {0, 0, 1},
                              .base = kShadowPlaneBase};
  measure_draw(state, kStagePixels, shader, stage_quad_positions_and_normals(), stage_quad_indices());
}
BENCHMARK(shader_shadowed);

void shader_star_sky(benchmark::State& state) {
  const std::array<glm::vec2, 4> corners{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  DrawState draw_state;
  draw_state.depth.test = false;
  measure_draw(state, kStagePixels, StarSky{}, make_vertex_view(stream(std::span<const glm::vec2>(corners))), stage_quad_indices(),
               draw_state);
}
BENCHMARK(shader_star_sky);

// The surface shader of the scenes, with Phong shading, a color map and 1 or 3 point lights.
void shader_surface(benchmark::State& state) {
  WorkloadAssets assets;
  const std::shared_ptr<const Texture2D> map = assets.checker();
  const std::vector<Light> lights(static_cast<std::size_t>(state.range(0)), Light{.type = LightType::point, .position_rws = {1, 1, 1}});
  SurfaceShader<ShadingRate::phong, true> shader{};
  shader.clip_from_object = glm::mat4(1.0f);
  shader.world_from_object = glm::mat4(1.0f);
  shader.world_from_object[3] = {0, 0, -2, 1};  // in front of the eye
  shader.normal_from_object = glm::mat3(1.0f);
  shader.lights = lights;
  shader.factors[kColor].map = map.get();
  shader.factors[kShininess].constant = glm::vec3(32.0f);
  measure_draw(state, kStagePixels, shader, stage_quad(), stage_quad_indices());
}
BENCHMARK(shader_surface)->Arg(1)->Arg(3);

// Only texture lookups, along the rows of a 1024 x 1024 texture. The pixel footprint is `step` texels wide and one texel high.
void look_up(benchmark::State& state, TexelFormat format, Sampler sampler, float step) {
  constexpr int kSize = 1024;
  const auto texture = [&] {
    switch (format) {
      case TexelFormat::r8: return Texture2D(Image<uint8_t>(kSize, kSize));
      case TexelFormat::r16: return Texture2D(Image<uint16_t>(kSize, kSize));
      case TexelFormat::rgba16f:
      case TexelFormat::rgba32f: return Texture2D(Image<glm::vec4>(kSize, kSize), format);
      default: return Texture2D(Image<glm::u8vec4>(kSize, kSize), format);
    }
  }();
  const vec2<Real> right(Real(step / kSize), Real(0.0f)), up(Real(0.0f), Real(1.0f / kSize));
  constexpr int kPackets = kSize / kLanes;
  int row = 0;
  for (auto _ : state) {
    row = (row + 1) % kSize;
    for (int p = 0; p < kPackets; ++p) {
      const Real x = to_real<Real>(iota<Int>() + p * kLanes) * Real(step / kSize);
      benchmark::DoNotOptimize(texture.sample(sampler, {x, Real(static_cast<float>(row) / kSize)}, right, up));
    }
  }
  state.SetItemsProcessed(state.iterations() * kSize);
}
constexpr Sampler kNearest{.mag = Filter::nearest, .min = Filter::nearest}, kBilinear{.min = Filter::bilinear};
BENCHMARK_CAPTURE(look_up, rgba8_nearest, TexelFormat::rgba8, kNearest, 1.0f);
BENCHMARK_CAPTURE(look_up, rgba8_bilinear, TexelFormat::rgba8, kBilinear, 1.0f);
BENCHMARK_CAPTURE(look_up, rgba8_trilinear, TexelFormat::rgba8, Sampler{}, 1.5f);
BENCHMARK_CAPTURE(look_up, rgba8_anisotropic_4, TexelFormat::rgba8, Sampler{.anisotropy = 4}, 4.0f);
BENCHMARK_CAPTURE(look_up, rgba8_anisotropic_16, TexelFormat::rgba8, Sampler{.anisotropy = 16}, 16.0f);
BENCHMARK_CAPTURE(look_up, srgb8a8_trilinear, TexelFormat::srgb8a8, Sampler{}, 1.5f);
BENCHMARK_CAPTURE(look_up, r8_trilinear, TexelFormat::r8, Sampler{}, 1.5f);
BENCHMARK_CAPTURE(look_up, r16_trilinear, TexelFormat::r16, Sampler{}, 1.5f);
BENCHMARK_CAPTURE(look_up, rgba16f_trilinear, TexelFormat::rgba16f, Sampler{}, 1.5f);
BENCHMARK_CAPTURE(look_up, rgba32f_trilinear, TexelFormat::rgba32f, Sampler{}, 1.5f);
BENCHMARK_CAPTURE(look_up, rgba8_border, TexelFormat::rgba8, (Sampler{.wrap_s = Wrap::border, .wrap_t = Wrap::border}), 1.5f);

}  // namespace

}  // namespace halfspace
