// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/geometry/face_triangles.h"

#include "halfspace/model/geometry/triangulate.h"

namespace halfspace::HS_LANES {

std::span<const uint32_t> FaceTriangles::of(std::span<const glm::dvec3> corners) {
  distinct_.clear();
  sources_.clear();
  triangles_.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!distinct_.empty() && corners[i] == distinct_.back()) continue;
    distinct_.push_back(corners[i]);
    sources_.push_back(static_cast<uint32_t>(i));
  }
  while (distinct_.size() > 1 && distinct_.back() == distinct_.front()) distinct_.pop_back();
  if (distinct_.size() < 3) return {};
  triangulate(distinct_, triangles_);
  for (uint32_t& corner : triangles_) corner = sources_[corner];
  return triangles_;
}

}  // namespace halfspace::HS_LANES
