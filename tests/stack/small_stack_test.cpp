// SPDX-License-Identifier: Apache-2.0
//
// Runs passes and scenes with stacks of 128 KiB, both on the calling thread and on std::thread workers. (TBB chooses the stack size of its
// own threads.)
#include "support/small_stack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "halfspace/core/parallel.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/random.h"
#include "support/sanitized.h"
#include "support/shaders.h"

namespace halfspace {
namespace {

class SmallStack : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "sanitizers enlarge stack frames";
  }
};

// With 1, the calling thread does all the work. A pool with more threads than the machine has cores uses std::threads.
INSTANTIATE_TEST_SUITE_P(Threads, SmallStack, testing::Values(1, Workers::cores() + 2));

// ---- verification of the stack size ----------------------------------------------------------------------------

__attribute__((noinline)) char touch_stack(std::size_t bytes) {
  volatile char* memory = static_cast<volatile char*>(__builtin_alloca(bytes));
  for (std::size_t i = 0; i < bytes; i += 1024) memory[bytes - 1 - i] = 1;
  return memory[0];
}

TEST(SmallStackDeathTest, OverflowsTerminateTheProgram) {
  if (kSanitized) GTEST_SKIP() << "sanitizers report stack overflows themselves";
  on_small_stack([] { touch_stack(kSmallStack / 2); });
  on_small_stack([] { std::thread([] { touch_stack(kSmallStack / 2); }).join(); });
  EXPECT_EXIT(on_small_stack([] { touch_stack(kSmallStack); }), testing::KilledBySignal(SIGSEGV), "");
  EXPECT_EXIT(on_small_stack([] { std::thread([] { touch_stack(kSmallStack); }).join(); }), testing::KilledBySignal(SIGSEGV), "");
  EXPECT_EXIT(on_small_stack([] { touch_stack(8 * kSmallStack); }), testing::KilledBySignal(SIGSEGV), "");
}

// ---- a pass ----------------------------------------------------------------------------------------------------

/// Outputs an interpolated color; also writes depth and discards fragments.
template <bool has_visibility>
struct WaveShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    vec4<R> color;
  };
  template <class R>
  PerVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return {in.position, R(4.0f) + in.color.x * R(20.0f)};
  }
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const Visibility<R> v{in.color.y > R(0.25f), px.z() * R(0.5f) + in.color.x * R(0.25f)};
    return {in.color, v.keep, v.depth};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const requires has_visibility {
    return {in.color.y > R(0.25f), px.z() * R(0.5f) + in.color.x * R(0.25f)};
  }
};

/// Two color outputs.
struct TwoColorShader : FlatColorShader {
  template <class R>
  FragmentMRT<R, 2> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {{in.color.value, vec4<R>(R(1.0f), R(0.5f), R(0.25f), R(1.0f))}};
  }
};

struct Vertices {
  std::vector<glm::vec4> positions, colors;
  auto view() const { return make_vertex_view(stream(positions), stream(colors)); }
};

/// Returns triangles of all sizes, some of which are clipped.
Vertices random_vertices(int triangles) {
  Random r(7);
  Vertices v;
  for (int t = 0; t < triangles; ++t) {
    const glm::vec2 center(r.real(-1.2f, 1.2f), r.real(-1.2f, 1.2f));
    const auto size = static_cast<float>(r.magnitude(0.01, 4.0));
    for (int i = 0; i < 3; ++i) {
      v.positions.emplace_back(center + size * glm::vec2(r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f)), r.real(-1.1f, 1.0f),
                               r.real(0.4f, 1.5f));
      v.colors.emplace_back(r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), r.real(0.0f, 1.0f));
    }
  }
  return v;
}

constexpr int kWidth = 300, kHeight = 200;

DrawState blended() {
  DrawState state;
  state.blend = BlendState{};
  return state;
}

void add_draws(Pass& pass, const Vertices& v) {
  pass.draw(FlatColorShader{}, v.view());
  pass.draw(ConstantShader{}, make_vertex_view(stream(v.positions)), blended());
  pass.draw(WaveShader<true>{}, v.view());
  pass.draw(WaveShader<false>{}, v.view(), blended());
  DrawState state;
  state.topology = Topology::points;
  state.point_size = 9.5f;
  pass.draw(FlatColorShader{}, v.view(), state);
  pass.draw(WaveShader<true>{}, v.view(), state);
  state.topology = Topology::line_strip;
  state.line_width = 3.0f;
  pass.draw(FlatColorShader{}, v.view(), state);
  state = blended();
  state.polygon_mode = PolygonMode::line;
  state.stencil = StencilState{{.pass = StencilOp::increment_wrap}, {.pass = StencilOp::invert}};
  state.sample_shading = true;
  state.query = 0;
  pass.draw(FlatColorShader{}, v.view(), state);
  pass.draw_depth(ConstantShader{}, make_vertex_view(stream(v.positions)));
}

void run_pass(int threads, const Vertices& v, const PassOptions& options) {
  Image<glm::vec4> light(kWidth, kHeight);
  Image<glm::u8vec4> codes(kWidth, kHeight), post(kWidth, kHeight);
  Image<DepthStencil> depth(kWidth, kHeight);
  const Workers workers(threads);
  Pass pass(kWidth, kHeight, std::vector{srgb8a8_target(codes), rgba32f_target(light)}, d32fs8_target(depth), options);
  add_draws(pass, v);
  pass.draw(TwoColorShader{}, v.view(), blended());
  pass.post([]<class R>(const vec4<R>& c) { return c * R(0.5f); }, srgb8a8_target(post));
  pass.run(workers);
  Pass packed(kWidth, kHeight, rgba8_target(codes), {.format = DepthFormat::d24s8}, options);
  add_draws(packed, v);
  packed.run(workers);
  EXPECT_TRUE(std::ranges::any_of(post.texels(), [](const glm::u8vec4& c) { return c.x > 0; }));
}

TEST_P(SmallStack, PassesRunOnSmallStacks) {
  const Vertices v = random_vertices(200);
  on_small_stack([&] {
    for (const int samples : {1, 4, 8}) {
      for (const bool defer : {true, false}) {
        run_pass(GetParam(), v, {.samples = samples, .tuning = {.defer = defer}});
        run_pass(GetParam(), v,
                 {.samples = samples, .supersample = true, .tuning = {.chunk_triangles = 16, .bin_budget = 0, .defer = defer}});
      }
    }
  });
}

// ---- emitting stages -------------------------------------------------------------------------------------------

/// Patches and primitives of the largest size.
struct LargePatches {
  static constexpr TessellationLayout tessellation_layout{.patch_vertices = 32, .domain = TessellationDomain::quads};
  static constexpr GeometryLayout geometry_layout{.max_vertices = 3};
  template <class R>
  using Attributes = ColoredAttributes<R>;
  template <class R>
  struct Varyings {
    std::array<vec4<R>, 16> values;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.values.fill(in.color);
    return in.position;
  }
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, Varyings<R>, 32>&) const {
    return {{R(3), R(3), R(3), R(3)}, {R(3), R(3)}};
  }
  template <class R>
  vec4<R> evaluate(const PatchInput<R, Varyings<R>, 32>& in, const vec3<R>& at, Varyings<R>& out) const {
    out = in.varyings[31];
    return in.position[0] * at.x + in.position[16] * at.y;
  }
  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    for (std::size_t i = 0; i < 3; ++i) out.emit(in.position[i], in.varyings[i]);
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.values[15]};
  }
};

TEST_P(SmallStack, LargePatchesAreDivided) {
  const Vertices v = random_vertices(320);
  on_small_stack([&] {
    Image<glm::vec4> image(64, 64);
    Pass pass(64, 64, rgba32f_target(image), {});
    pass.draw(LargePatches{}, make_vertex_view(stream(v.positions), stream(v.colors)), {.topology = Topology::patches});
    EXPECT_EQ(pass.run(Workers(GetParam())).primitives_in, 30u * 18u);
  });
}

// ---- scenes ----------------------------------------------------------------------------------------------------

void render_scene(const std::string& name, const std::vector<std::string>& settings, int threads) {
  SceneFile file = SceneFile::open(name);
  file.set(settings);
  const Workers workers(threads);
  SceneAssets assets(workers);
  Image<glm::u8vec4> picture(96, 54);
  Image<float> depth(96, 54);
  Image<glm::vec3> normal(96, 54), barycentrics(96, 54);
  render_frame(assets.prepare(file.at(0.0), picture.width(), picture.height()),
               {.picture = &picture, .depth = &depth, .normal = &normal, .barycentrics = &barycentrics}, workers);
  EXPECT_TRUE(std::ranges::any_of(picture.texels(), [&](const glm::u8vec4& c) { return c != picture.at(0, 0); })) << name;
}

TEST_P(SmallStack, ScenesRenderOnSmallStacks) {
  on_small_stack([&] {
    render_scene("shapes", {}, GetParam());
    render_scene("day-night", {"samples=4"}, GetParam());
    render_scene("moon", {"shadow.method=moments"}, GetParam());
    render_scene("particles", {}, GetParam());
  });
}

}  // namespace
}  // namespace halfspace
