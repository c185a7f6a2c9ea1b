// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace halfspace {

/// How far edges lie from others, in pixels. 0 where there are none.
struct EdgeDistance {
  double mean = 0.0, p95 = 0.0, max = 0.0;
};

/// From each pixel of `from` to the nearest of `to`, in a picture of width x height pixels.
EdgeDistance edge_distance(const std::vector<glm::ivec2>& from, const std::vector<glm::ivec2>& to, int width, int height);

}  // namespace halfspace
