// SPDX-License-Identifier: Apache-2.0
//
// Shared by the benchmarks of single stages. The stages are measured through passes, as users run them: each benchmark draws something that
// spends nearly all of its time in one stage. All benchmarks use one thread.
#pragma once

#include <benchmark/benchmark.h>

#include "workloads/workload_assets.h"
#include "workloads/workload_canvas.h"
#include "workloads/workload_geometry.h"

namespace halfspace {

inline constexpr WorkloadSize kStageSize{1024, 1024};
inline constexpr int64_t kStagePixels = int64_t{kStageSize.width} * kStageSize.height;

/// Calls `draw` repeatedly and reports the rate of items per second, where `items` is the number of items per pass.
template <class Draw>
void measure_passes(benchmark::State& state, int64_t items, Draw draw) {
  const Workers one(1);
  for (auto _ : state) draw(one);
  state.SetItemsProcessed(state.iterations() * items);
}

/// Measures passes that clear color and depth and draw one mesh.
template <class S>
void measure_draw(benchmark::State& state, int64_t items, const S& shader, const VertexView& vertices, const Indices& indices,
                  const DrawState& draw_state = {}, const PassOptions& options = {}) {
  Image<glm::u8vec4> color(kStageSize.width, kStageSize.height);
  Image<float> depth(kStageSize.width, kStageSize.height);
  measure_passes(state, items, [&](const Workers& workers) {
    Pass pass(kStageSize.width, kStageSize.height, rgba8_target(color), d32f_target(depth), options);
    if constexpr (!HasFragmentFunction<S>) {
      pass.draw_depth(shader, vertices, indices, draw_state);
    } else {
      pass.draw(shader, vertices, indices, draw_state);
    }
    pass.run(workers);
  });
}

/// A quad over the whole image with all vertex attributes that the shaders need: position, normal towards the eye, and texture coordinates
/// from 0 to 1.
inline constexpr std::array<SphereVertex, 4> kStageQuad{
    {{{-1, -1, 0}, {0, 0, 1}, {0, 1}}, {{1, -1, 0}, {0, 0, 1}, {1, 1}}, {{-1, 1, 0}, {0, 0, 1}, {0, 0}}, {{1, 1, 0}, {0, 0, 1}, {1, 0}}}};
inline VertexView stage_quad() { return make_vertex_view(stream(std::span<const SphereVertex>(kStageQuad))); }
inline VertexView stage_quad_positions() {
  return make_vertex_view(stream(std::span<const SphereVertex>(kStageQuad), &SphereVertex::position));
}
inline VertexView stage_quad_positions_and_normals() {
  return make_vertex_view(stream(std::span<const SphereVertex>(kStageQuad), &SphereVertex::position),
                          stream(std::span<const SphereVertex>(kStageQuad), &SphereVertex::normal));
}
inline Indices stage_quad_indices() { return {std::span<const uint32_t>(kStripTriangles), kStageQuad.size()}; }

}  // namespace halfspace
