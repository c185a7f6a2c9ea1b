// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "halfspace/core/image.h"

namespace halfspace::HS_LANES {

/// Statistics of the distance between two sets of edges, in pixels; 0 if there are none.
struct EdgeDistance {
  double mean = 0.0, p95 = 0.0, max = 0.0;
};

EdgeDistance summary_of(std::vector<double> distances);

/// Returns the distance from each pixel of `from` to the nearest pixel of `to`, in an image of width x height pixels.
/// Returns an empty vector if `to` is empty.
std::vector<double> edge_distances(const std::vector<glm::ivec2>& from, const std::vector<glm::ivec2>& to, int width, int height);

/// Estimates how far edges have moved, given an image in which wrong pixels are nonzero. An edge that has moved leaves a band of wrong
/// pixels as wide as its displacement. A thin feature that has vanished leaves a band as wide as the feature. In the middle of a band of
/// width w, the nearest correct pixel is (w + 1)/2 away, so a distance d counts as a width of 2d - 1. `finer` is the supersampling factor
/// of `wrong`; the result is in pixels of the original image. Returns 0 if no pixel is wrong.
EdgeDistance wrong_band_width(const Image<uint8_t>& wrong, int finer);

}  // namespace halfspace::HS_LANES
