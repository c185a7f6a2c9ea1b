// SPDX-License-Identifier: Apache-2.0
//
// Pixel histories in a page: draw, primitive, depth and outcome of the fragments of every pixel, and all values of those of some pixels.
#pragma once

#include <vector>

#include "halfspace/explain/page_data.h"
#include "halfspace/explain/pixel_history.h"

namespace halfspace {

/// Limits that keep a page below 25 MB: fragments, and numbers of fragments with all values. If a frame has more, each pixel keeps fewer
/// fragments; the number of the others is stored.
inline constexpr std::size_t kMaxPageFragments = 1'600'000, kMaxPageValues = 1'500'000;

/// Returns the largest number of fragments per pixel, at most FrameTrace::kMaxFragments, with which a page has at most `most` fragments,
/// or 1.
uint32_t fragments_per_pixel(const FrameTrace& trace, std::size_t most);

/// Returns the indices of the fragments of a pixel that a page keeps, in order: the shaded ones, and then the first ones of the others.
std::vector<uint32_t> kept_fragments(std::span<const TracedFragment> fragments, uint32_t most);

/// Returns the pixels with all values: 64x64 pixels around the center, and every eighth pixel in x and y. By row, without duplicates.
std::vector<glm::ivec2> detailed_pixels(int width, int height, glm::ivec2 center);

PageJson histories_json(const PageInput& in, const FrameTrace& trace);

}  // namespace halfspace
