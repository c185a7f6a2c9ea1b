// SPDX-License-Identifier: Apache-2.0
//
// Sizes at which the code path of a triangle changes. The pixels are the same on all paths.
//
//   word     bounding box                path
//   narrow   at most 63 x 63 px          setup W at once; edge functions in int32 without a shift
//   small    at most 48 x 48 px          visibility W at once, packet by packet; larger ones go block by block
//   tested   at least 24 pixels in all   hierarchical Z may reject it; testing fewer pixels takes less time than the comparison
//   tiny     at most 4 x 3 px            setup stores its pixels if there is one sample; up to 4 x 4 px, it culls uncovered triangles
#pragma once

#include "halfspace/raster/pipeline/window.h"

namespace halfspace::HS_LANES {

/// Largest extent of a narrow triangle in 1/256 px. In any tile that it touches, all edge functions fit in int32 without a shift. A sample
/// is at most (63 + 64)·256 < 2^15 sub-pixels from a vertex, and an edge is at most 63·256 < 2^14 sub-pixels long in x and y. The
/// difference of two products of such distances is below 2^30.
inline constexpr int32_t kNarrowExtent = 63 * kSubPixels;

/// Largest extent of a small triangle in pixels.
inline constexpr int kSmallExtent = 48;

/// Fewer pixels than this are not worth a test of the depth bounds of a block, which may have to be recomputed (measured on Zen 3).
inline constexpr int kTestedPixels = 24;

/// Setup tests the coverage of bounding boxes of at most this many pixels per side, and stores it for at most kTinyRows rows.
inline constexpr int kTinySide = 4;
inline constexpr int kTinyRows = 3;

}  // namespace halfspace::HS_LANES
