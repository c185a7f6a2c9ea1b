// SPDX-License-Identifier: Apache-2.0
#include "explain/stage_emission.h"

#include <set>
#include <utility>

#include "halfspace/core/float_mode.h"
#include "halfspace/raster/amplify/emit_primitives.h"
#include "halfspace/raster/amplify/emitting_stages.h"
#include "halfspace/raster/detail/run_pass.h"
#include "halfspace/render/frame/scene_pass.h"

namespace halfspace {

namespace {

bool is_in_window(const EmittedPrimitives& p, std::size_t v, glm::ivec2 size) {
  if (!(clip_position(p, v).w > 0.0f)) return false;
  const glm::dvec2 at = window_position(p, v, size);
  return at.x >= 0.0 && at.y >= 0.0 && at.x < size.x && at.y < size.y;
}

bool primitive_is_in_window(const EmittedPrimitives& p, std::size_t i, glm::ivec2 size) {
  const std::size_t n = p.vertices_per_primitive();
  for (std::size_t v = i * n; v < (i + 1) * n; ++v) {
    if (!is_in_window(p, v, size)) return false;
  }
  return true;
}

}  // namespace

std::vector<StageEmission> stage_emissions(const PreparedScene& scene, const Workers& workers) {
  std::vector<StageEmission> out;
  Image<glm::u8vec4> unused(scene.view.width_px, scene.view.height_px);
  render_with(scene, unused, workers, [&](Pass& pass) {
    const FloatMode mode;
    const std::vector<Draw>& draws = recorded_pass(pass).context.draws;
    for (std::size_t i = 0; i < draws.size(); ++i) {
      const EmittingStages* const stages = draws[i].kernels.emitting;
      if (stages == nullptr || stages->geometry == nullptr) continue;
      PassStatistics statistics;
      out.push_back({static_cast<uint32_t>(i), assemble_primitives(draws[i], stages->vertex, stages->varying_count, workers),
                     emit_primitives(draws[i], workers, statistics)});
    }
    return PassStatistics{};
  });
  return out;
}

glm::vec4 clip_position(const EmittedPrimitives& p, std::size_t v) {
  const float* const row = p.rows.data() + p.indices[v] * p.row;
  return {row[0], row[1], row[2], row[3]};
}

glm::dvec2 window_position(const EmittedPrimitives& p, std::size_t v, glm::ivec2 size) {
  const glm::dvec4 clip(clip_position(p, v));
  return (glm::dvec2(clip.x, clip.y) / clip.w + 1.0) * 0.5 * glm::dvec2(size);
}

std::vector<std::size_t> emitted_for(const StageEmission& e, std::size_t received) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < e.emitted.primitive_count(); ++i) {
    if (e.emitted.numbers[i] == e.received.numbers[received] && e.emitted.instances[i] == e.received.instances[received]) out.push_back(i);
  }
  return out;
}

std::optional<std::size_t> emission_example(const StageEmission& e, bool mirrored, glm::ivec2 size) {
  std::optional<std::size_t> best;
  double largest = 0.0;
  if (e.received.topology != Topology::triangles) return best;
  std::set<std::pair<uint32_t, uint32_t>> leaving;  // instances and numbers of primitives for which one outside of the window was emitted
  for (std::size_t k = 0; k < e.emitted.primitive_count(); ++k) {
    if (!primitive_is_in_window(e.emitted, k, size)) leaving.emplace(e.emitted.instances[k], e.emitted.numbers[k]);
  }
  for (std::size_t i = 0; i < e.received.primitive_count(); ++i) {
    if (!primitive_is_in_window(e.received, i, size)) continue;
    const auto at = [&](std::size_t k) { return window_position(e.received, 3 * i + k, size); };
    const glm::dvec2 a = at(1) - at(0), b = at(2) - at(0);
    const double area = (a.x * b.y - a.y * b.x) * (mirrored ? -1.0 : 1.0);
    if (!(area > largest) || leaving.contains({e.received.instances[i], e.received.numbers[i]})) continue;
    largest = area;
    best = i;
  }
  return best;
}

}  // namespace halfspace
