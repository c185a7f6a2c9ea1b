// SPDX-License-Identifier: Apache-2.0
//
// Immediate shading, in submission order: what blends, and what only its fragment function can decide.
#pragma once

#include "halfspace/raster/shade/fragment_batch.h"

namespace halfspace {

/// Shades one triangle's packets now: late tests where needed, blending, colour write.
void shade_immediate(const PassContext& context, const Draw& draw, TriangleId id, VisibilityMode mode, const CoverageList& list, Tile& tile,
                     PassStatistics& statistics);

}  // namespace halfspace
