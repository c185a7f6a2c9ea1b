// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/detail/state_checks.h"

#include <cmath>

#include "halfspace/core/check.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/raster/detail/target_checks.h"
#include "halfspace/raster/tile/blend.h"
#include "halfspace/raster/tile/logic_op.h"

namespace halfspace::HS_LANES::detail {

namespace {

constexpr float kMinViewportSize = 1.0f / 256.0f;

// Comparisons are written so that NaN fails.
void check_viewport(const ViewportRect& r) {
  constexpr auto limit = static_cast<float>(kMaxTargetSize);
  HS_CHECK(r.width >= kMinViewportSize && r.width <= limit && std::fabs(r.height) >= kMinViewportSize && std::fabs(r.height) <= limit,
           "DrawState: the size of the viewport is outside of its range; expected a width from 1/256 to 16384, and a height from 1/256 to "
           "16384 or negative");
  HS_CHECK(std::fabs(r.x) <= limit && std::fabs(r.y) <= limit,
           "DrawState: the origin of the viewport is too far away; expected at most 16384 from 0");
}

void check_scissor(const Rect& r) {
  HS_CHECK(r.width >= 0 && r.height >= 0,
           "Pass: the size of a scissor or a cleared rectangle is negative; expected a width and a height of at least 0");
}

void check_viewports(const ViewportArray& viewports) {
  HS_CHECK(!viewports.empty() && viewports.size() <= kMaxViewports,
           "DrawState::viewports: the number of viewports is outside of its range; expected 1 to 16");
  for (const IndexedViewport& v : viewports) {
    if (v.viewport) check_viewport(*v.viewport);
    if (v.scissor) check_scissor(*v.scissor);
    HS_CHECK(v.range_near >= 0.0f && v.range_near <= 1.0f && v.range_far >= 0.0f && v.range_far <= 1.0f,
             "DrawState::viewports: a depth range is outside of its range; expected 0 to 1");
  }
}

void check_numbers(const DrawState& state) {
  HS_CHECK_OP(state.line_width, >=, 0.0f, "line_width: is negative or NaN; expected 0 to 4096");
  HS_CHECK_OP(state.line_width, <=, kMaxLineWidth, "line_width: is too large; expected 0 to 4096");
  HS_CHECK_OP(state.point_size, >=, 0.0f, "point_size: is negative or NaN; expected at least 0");
  HS_CHECK_OP(std::fabs(state.offset.slope), <, detail::kInfinity, "offset.slope: is not finite; expected a finite number");
  HS_CHECK_OP(std::fabs(state.offset.constant), <, detail::kInfinity, "offset.constant: is not finite; expected a finite number");
  HS_CHECK(state.offset.clamp == state.offset.clamp, "offset.clamp: is NaN; expected a number");
  HS_CHECK(state.depth.range_near >= 0 && state.depth.range_near <= 1 && state.depth.range_far >= 0 && state.depth.range_far <= 1,
           "DrawState: the depth range is outside of its limits; expected two depths from 0 to 1");
  if (state.sample_coverage) {
    HS_CHECK(state.sample_coverage->value >= 0.0f && state.sample_coverage->value <= 1.0f,
             "sample_coverage: the value is outside of its range; expected 0 to 1");
  }
  HS_CHECK(state.min_sample_shading >= 0.0f && state.min_sample_shading <= 1.0f,
           "min_sample_shading: is outside of its range; expected 0 to 1");
  if (state.depth_bounds) {
    const auto& [low, high] = *state.depth_bounds;
    HS_CHECK(low >= 0.0f && low <= high && high <= 1.0f,
             "depth_bounds: the range is empty or outside of its limits; expected two depths from 0 to 1, the smaller one first");
  }
  if (state.query) HS_CHECK_OP(*state.query, <, kMaxQueries, "query: is too large; expected less than 65536");
  if (state.timer) HS_CHECK_OP(*state.timer, <, kMaxQueries, "timer: is too large; expected less than 65536");
  HS_CHECK(!state.condition || state.query != state.condition->query,
           "DrawState::condition: depends on the query of the draw itself; expected another query");
  if (state.viewport) check_viewport(*state.viewport);
  if (state.scissor) check_scissor(*state.scissor);
  if (state.viewports != nullptr) check_viewports(*state.viewports);
}

}  // namespace

void check_state(const DrawState& state, const Attachments& attachments) {
  check_numbers(state);
  for (std::size_t i = attachments.colors.size(); i < state.attachments.size(); ++i)
    HS_CHECK(!state.attachments[i], "DrawState: there is a state for an attachment that the pass does not have; expected none");
  if (state.order_independent) {
    HS_CHECK(attachments.colors.size() == 1 && attachments.has_color && !is_integer(attachments.colors[0].format),
             "DrawState: order_independent needs one color target of colors; expected no integers and no second target");
    HS_CHECK(
        !state.depth.write && !blend_of(state, 0) && color_mask_of(state, 0).all() && !state.logic_op && !state.alpha_to_one,
        "DrawState: order_independent is combined with depth writes, blending, a color mask, a logic operation or alpha_to_one; expected "
        "none of them");
    HS_CHECK(state.depth.compare == CompareOp::less || state.depth.compare == CompareOp::less_equal ||
                 state.depth.compare == CompareOp::greater || state.depth.compare == CompareOp::greater_equal,
             "DrawState: order_independent is combined with another depth test; expected less, less_equal, greater or greater_equal");
  }
  for (std::size_t i = 0; i < attachments.colors.size(); ++i) {
    HS_CHECK(!blend_of(state, i) || !is_integer(attachments.colors[i].format),
             "DrawState: a target of integers is blended; expected no blending");
    if (!state.logic_op || attachments.colors[i].format == ColorFormat::none) continue;
    HS_CHECK(has_logic_op(attachments.colors[i].format),
             "DrawState: logic_op applies to a target of floats, signed normalized or sRGB values; expected unsigned normalized values or "
             "integers");
    HS_CHECK(!blend_of(state, i), "DrawState: logic_op is combined with blending; expected one of them");
  }
}

}  // namespace halfspace::HS_LANES::detail
