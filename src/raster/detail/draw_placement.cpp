// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/detail/draw_placement.h"

#include <algorithm>

#include "halfspace/core/float_mode.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace::HS_LANES::detail {

namespace {

// Returns the samples that may be drawn, as bits.
uint32_t coverage_mask(const std::optional<SampleCoverage>& coverage, int samples) {
  const uint32_t all = (1u << samples) - 1;
  if (!coverage) return all;
  const auto count = static_cast<uint32_t>(coverage->value * static_cast<float>(samples) + 0.5f);
  const uint32_t covered = (1u << count) - 1;
  return coverage->invert ? all & ~covered : covered;
}

PixelBounds to_bounds(const Rect& r) { return {r.x, r.y, r.x + r.width, r.y + r.height}; }

}  // namespace

Rect drawable_rect(const Rect& viewport, const std::optional<Rect>& scissor, int width, int height) {
  const Rect inside = intersect({0, 0, width, height}, viewport);
  return scissor ? intersect(inside, *scissor) : inside;
}

DrawPlacement place_draw(const DrawState& state, const PassContext& context, const Attachments& attachments, bool supersample) {
  const FloatMode float_mode;
  const Rect viewport = state.viewport.value_or(Rect{0, 0, context.width, context.height});
  const bool has_integers = !attachments.colors.empty() && is_integer(attachments.colors[0].format);
  return {.viewport = make_viewport(viewport, state.depth),
          .bounds = to_bounds(drawable_rect(viewport, state.scissor, context.width, context.height)),
          .depth_low = std::min(state.depth.range_near, state.depth.range_far),
          .depth_high = std::max(state.depth.range_near, state.depth.range_far),
          .sample_mask = context.samples == 1 ? 1u : state.sample_mask & coverage_mask(state.sample_coverage, context.samples),
          .shades_samples = context.samples > 1 && (state.sample_shading || supersample),
          .covers_by_alpha = state.alpha_to_coverage && context.samples > 1 && !has_integers,
          .sets_alpha_to_one = state.alpha_to_one && context.samples > 1};
}

}  // namespace halfspace::HS_LANES::detail
