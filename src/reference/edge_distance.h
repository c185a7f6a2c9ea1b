// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "halfspace/core/image.h"

namespace halfspace {

/// How far edges lie from others, in pixels. 0 where there are none.
struct EdgeDistance {
  double mean = 0.0, p95 = 0.0, max = 0.0;
};

EdgeDistance summary_of(std::vector<double> distances);

/// From each pixel of `from` to the nearest of `to`, in a picture of width x height pixels; empty where there is none in `to`.
std::vector<double> edge_distances(const std::vector<glm::ivec2>& from, const std::vector<glm::ivec2>& to, int width, int height);

/// How far edges have moved, told by the pixels that are wrong (not 0): an edge that has moved leaves a band of them as wide as its way,
/// and so does a gap or a thin thing that has vanished. A band is twice as wide as its pixels lie from right ones (less the pixel between
/// whose middles its borders lie); for a picture `finer` times as fine as the one whose pixels are told. 0 where none is wrong.
EdgeDistance wrong_band_width(const Image<uint8_t>& wrong, int finer);

}  // namespace halfspace
