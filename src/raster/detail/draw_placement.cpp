// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/detail/draw_placement.h"

#include <algorithm>
#include <cmath>

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

// OpenGL 4.6, section 14.3.1.1, allows shading more samples than the fraction asks for. All are shaded if one is not enough.
bool shades_samples(const DrawState& state, int samples) {
  return state.sample_shading && state.min_sample_shading * static_cast<float>(samples) > 1.0f;
}

}  // namespace

ViewportRect rounded_viewport(const std::optional<ViewportRect>& viewport, int width, int height) {
  const ViewportRect v = viewport.value_or(Rect{0, 0, width, height});
  constexpr auto scale = static_cast<float>(kSubPixels);
  const auto rounded = [](float x) { return std::nearbyint(x * scale) / scale; };
  return {rounded(v.x), rounded(v.y), rounded(v.width), rounded(v.height)};
}

Rect drawable_rect(const ViewportRect& viewport, const std::optional<Rect>& scissor, int width, int height, const SampleSpan& samples_at) {
  constexpr auto scale = static_cast<float>(kSubPixels);
  // Returns the first pixel in which a sample at this place (1/256 px) is not before x.
  const auto first = [&](float x, int sample) { return static_cast<int>(std::ceil(x - static_cast<float>(sample) / scale)); };
  const float low_y = std::min(viewport.y, viewport.y + viewport.height), high_y = std::max(viewport.y, viewport.y + viewport.height);
  const int x = first(viewport.x, samples_at.high), y = first(low_y, samples_at.high);
  const Rect pixels{x, y, first(viewport.x + viewport.width, samples_at.low) - x, first(high_y, samples_at.low) - y};
  const Rect inside = intersect({0, 0, width, height}, pixels);
  return scissor ? intersect(inside, *scissor) : inside;
}

DrawPlacement place_draw(const DrawState& state, const PassContext& context, const Attachments& attachments, bool supersample) {
  const FloatMode float_mode;
  const ViewportRect viewport = rounded_viewport(state.viewport, context.width, context.height);
  // A side of a viewport can separate the samples of a pixel. Only filled triangles are cut there: others end at the sides of pixels,
  // because a clipped outline would follow the side, and lines and points would lose parts inside of the viewport.
  const auto is_whole = [](float x) { return x == std::floor(x); };
  const bool clips_sides = context.samples > 1 && is_triangles(state.topology) && state.polygon_mode == PolygonMode::fill &&
                           !(is_whole(viewport.x) && is_whole(viewport.y) && is_whole(viewport.width) && is_whole(viewport.height));
  const bool has_integers = !attachments.colors.empty() && is_integer(attachments.colors[0].format);
  return {.viewport = make_viewport(viewport, state.depth, state.clip_origin, clips_sides),
          .bounds = to_bounds(drawable_rect(viewport, state.scissor, context.width, context.height, context.samples_at)),
          .depth_low = std::min(state.depth.range_near, state.depth.range_far),
          .depth_high = std::max(state.depth.range_near, state.depth.range_far),
          .sample_mask = context.samples == 1 ? 1u : state.sample_mask & coverage_mask(state.sample_coverage, context.samples),
          .is_multisampled = context.samples > 1,
          .state_shades_samples = context.samples > 1 && (shades_samples(state, context.samples) || supersample),
          .covers_by_alpha = state.alpha_to_coverage && context.samples > 1 && !has_integers,
          .sets_alpha_to_one = state.alpha_to_one && context.samples > 1};
}

}  // namespace halfspace::HS_LANES::detail
