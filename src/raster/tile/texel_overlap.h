// SPDX-License-Identifier: Apache-2.0
//
// Views that share memory.
#pragma once

#include "halfspace/core/texel_view.h"

namespace halfspace::HS_LANES {

/// Returns true if two views have a byte in common. Rectangles of one image, whose rows alternate in memory, do not have to. If the
/// distances of their rows differ, the result is true as soon as the ranges of their addresses overlap.
bool overlap(const ConstTexelView& a, const ConstTexelView& b);

/// Returns true if two layers of a view have a byte in common.
bool has_overlapping_layers(const ConstTexelView& view);

}  // namespace halfspace::HS_LANES
