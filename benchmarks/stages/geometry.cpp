// SPDX-License-Identifier: Apache-2.0
//
// Vertex shading, clipping, setup, binning and visibility. Items are vertices or triangles.
#include "halfspace/raster/primitives/clip.h"
#include "halfspace/raster/primitives/vertex_stage.h"
#include "halfspace/shading/surface/depth_only.h"
#include "stages/stage_pass.h"
#include "workloads/sphere_camera.h"

namespace halfspace {

namespace {

constexpr DrawState kNothingSurvives{.cull = CullMode::front_and_back};
const DepthOnly kIdentity{glm::mat4(1.0f)};

// Shades all vertices of a sphere. All its triangles are then culled.
void vertex_position(benchmark::State& state) {
  WorkloadAssets assets;
  const SphereAssets sphere(k200k, assets);
  const DepthOnly shader{sphere_uniforms(kStageSize, *sphere.texture).clip_from_world};
  const VertexView positions = make_vertex_view(stream(sphere.mesh->vertices, &SphereVertex::position));
  measure_draw(state, static_cast<int64_t>(sphere.mesh->vertices.size()), shader, positions,
               Indices::sequential(sphere.mesh->vertices.size()), kNothingSurvives);
}
BENCHMARK(vertex_position);

template <class S>
void vertex(benchmark::State& state) {
  WorkloadAssets assets;
  const SphereAssets sphere(k200k, assets);
  const S shader{sphere_uniforms(kStageSize, *sphere.texture)};
  measure_draw(state, static_cast<int64_t>(sphere.mesh->vertices.size()), shader, sphere.vertex_view(),
               Indices::sequential(sphere.mesh->vertices.size()), kNothingSurvives);
}
BENCHMARK_TEMPLATE(vertex, SpherePhong);
BENCHMARK_TEMPLATE(vertex, SphereGouraud);

// Clips a single triangle against the near plane or one side of the guard band.
void clip(benchmark::State& state) {
  const DepthState depth;
  const Viewport viewport = make_viewport({0, 0, kStageSize.width, kStageSize.height}, depth);
  const float far_out = state.range(0) == 0 ? 0.5f : 1e4f, behind = state.range(0) == 0 ? -2.0f : 0.5f;
  const std::array<glm::vec4, 3> triangle{{{0, 0, behind, 1}, {far_out, 0, 0.5f, 1}, {0, 0.5f, 0.5f, 1}}};
  for (auto _ : state) benchmark::DoNotOptimize(clip_triangle(viewport, depth, triangle));
  state.SetLabel(state.range(0) == 0 ? "near plane" : "guard band");
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(clip)->Arg(0)->Arg(1);

// 4,096 right triangles, each drawn 32 times. The vertex at the right angle is offset by (corner, corner) px from the lower-left corner of
// a pixel, and the legs are `leg` px long.
struct RepeatedTriangles {
  std::vector<glm::vec3> corners;
  std::vector<uint32_t> list;

  RepeatedTriangles(double corner, double leg, double z) {
    for (int t = 0; t < 4096; ++t) {
      const double x = 16 * (t % 64) + corner, y = 16 * (t / 64) + corner;
      const auto add = [&](double px, double py) {
        corners.emplace_back(glm::dvec3(2 * px / kStageSize.width - 1, 2 * py / kStageSize.height - 1, z));
      };
      add(x, y);
      add(x + leg, y);
      add(x, y + leg);
    }
    for (int i = 0; i < 32; ++i) {
      for (uint32_t v = 0; v < corners.size(); ++v) list.push_back(v);
    }
  }
  int64_t count() const { return static_cast<int64_t>(list.size() / 3); }
  VertexView view() const { return make_vertex_view(stream(corners)); }
  Indices indices() const { return {list, corners.size()}; }
};

void set_up_culled_face(benchmark::State& state) {
  const RepeatedTriangles triangles(2.0, 4.0, 0.5);
  measure_draw(state, triangles.count(), kIdentity, triangles.view(), triangles.indices(), {.cull = CullMode::front});
}
BENCHMARK(set_up_culled_face);

// The triangles cover no sample, so setup ends after computing their bounds.
void set_up_no_sample(benchmark::State& state) {
  const RepeatedTriangles triangles(0.6, 0.3, 0.5);
  measure_draw(state, triangles.count(), kIdentity, triangles.view(), triangles.indices());
}
BENCHMARK(set_up_no_sample);

// Triangles behind a quad. They are set up and binned into one tile or four, and rejected there by their minimum depth.
void bin(benchmark::State& state) {
  const bool across = state.range(0) == 4;
  RepeatedTriangles triangles(2.0, 4.0, 0.5);
  if (across) {  // move them to the corner of four tiles, for any tile size up to 64
    for (glm::vec3& c : triangles.corners) {
      const glm::vec2 px = (glm::vec2(c) + 1.0f) * 0.5f * glm::vec2(kStageSize.width, kStageSize.height);
      const glm::vec2 moved = glm::mod(px, 16.0f) - glm::vec2(4.0f) + glm::floor(px / 64.0f) * 64.0f;
      c = glm::vec3(moved / glm::vec2(kStageSize.width, kStageSize.height) * 2.0f - 1.0f, c.z);
    }
  }
  const Indices quad = stage_quad_indices(), list = triangles.indices();
  Image<float> depth(kStageSize.width, kStageSize.height);
  measure_passes(state, triangles.count(), [&](const Workers& workers) {
    Pass pass(kStageSize.width, kStageSize.height, ColorTarget{}, d32f_target(depth));
    pass.draw_depth(kIdentity, stage_quad_positions(), quad);  // at depth 0.5
    pass.draw_depth(kIdentity, triangles.view(), list);        // at depth 0.75
    pass.run(workers);
  });
  state.SetLabel(across ? "triangles in 4 tiles" : "triangles in 1 tile");
}
BENCHMARK(bin)->Arg(1)->Arg(4);

// Draws only depth: adjacent triangles of the given area in px² that cover about a million pixels or more. For smaller triangles, a larger
// part of the time is spent in vertex shading and setup.
void visibility(benchmark::State& state) {
  const int64_t area = state.range(0);
  const int count = static_cast<int>(std::max<int64_t>(1 << 20, 2 * area) / area);
  const std::vector<glm::vec3> corners = tiny_triangles(kStageSize, count, static_cast<double>(area));
  measure_draw(state, count, kIdentity, make_vertex_view(stream(corners)), Indices::sequential(corners.size()));
}
BENCHMARK(visibility)->RangeMultiplier(4)->Range(1, 1 << 18);

}  // namespace

}  // namespace halfspace
