// SPDX-License-Identifier: Apache-2.0
//
// Pixel histories in a page: draw, primitive, depth and outcome of the fragments of all pixels, and all values for some pixels.
#pragma once

#include <vector>

#include "explain/page_data.h"
#include "explain/pixel_history.h"

namespace halfspace {

/// Limits that keep a page below 25 MB (tests/explain/page_size_test.cpp): on the number of fragments, and on the total number of values of
/// the fragments that are stored with all values. If a frame exceeds a limit, the page contains fewer fragments per pixel, or the values of
/// fewer fragments. It stores the index of each fragment, and the number of omitted ones. All fragments of a FrameTrace are listed for the
/// pixels of detailed_pixels().
inline constexpr std::size_t kMaxPageFragments = 2'600'000, kMaxPageValues = 4'000'000;

/// Returns the largest number of fragments per pixel for which the page has at most `max_fragments` fragments. The result is between 1 and
/// FrameTrace::kMaxFragments.
uint32_t fragments_per_pixel(const FrameTrace& trace, std::size_t max_fragments);

/// Returns the indices of at most `max_fragments` fragments of a pixel, in order. Shaded fragments are preferred over others, and earlier
/// fragments over later ones.
std::vector<uint32_t> kept_fragments(std::span<const TracedFragment> fragments, uint32_t max_fragments);

/// Returns the pixels that are stored with all values: all pixels of a picture of at most 320x180 pixels; otherwise the center, 64x64
/// pixels around it, and every eighth pixel in x and y. They are sorted by row, without duplicates.
std::vector<glm::ivec2> detailed_pixels(int width, int height, glm::ivec2 center);

PageJson histories_json(const PageInput& in, const FrameTrace& trace);

}  // namespace halfspace
