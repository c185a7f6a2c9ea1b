// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Triangulates the faces of a file, in which neighboring corners may coincide.
class FaceTriangles {
 public:
  /// Returns the triangles of a polygon as indices into `corners`; see triangulate(). Neighboring corners with equal positions count as
  /// one. Empty if fewer than three corners remain. Valid until the next call.
  std::span<const uint32_t> of(std::span<const glm::dvec3> corners);

 private:
  std::vector<glm::dvec3> distinct_;
  std::vector<uint32_t> sources_, triangles_;
};

}  // namespace halfspace::HS_LANES
