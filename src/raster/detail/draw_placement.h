// SPDX-License-Identifier: Apache-2.0
//
// What follows from the state of a draw and from its pass.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/attachments.h"

namespace halfspace::HS_LANES::detail {

/// supersample: see PassOptions. The context must have the size and the samples of the pass.
DrawPlacement place_draw(const DrawState& state, const PassContext& context, const Attachments& attachments, bool supersample);

/// Returns a viewport with fractions of 1/256 px. Default: the whole target.
ViewportRect rounded_viewport(const std::optional<ViewportRect>& viewport, int width, int height);

/// Returns the pixels that a draw with this viewport and scissor can change. samples_at: positions of the samples in a pixel.
Rect drawable_rect(const ViewportRect& viewport, const std::optional<Rect>& scissor, int width, int height, const SampleSpan& samples_at);

}  // namespace halfspace::HS_LANES::detail
