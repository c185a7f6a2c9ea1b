// SPDX-License-Identifier: Apache-2.0
//
// Intersects ray packets with a mesh, using Embree (version 3.13 or 4).
#pragma once

#include <memory>

#include "halfspace/core/lanes.h"
#include "halfspace/core/vec.h"
#include "workloads/workload_assets.h"

namespace halfspace {

/// Rays per packet: the number of lanes of the build, but at least four.
inline constexpr int kRays = kLanes >= 4 ? kLanes : 4;
using RayReal = RealN<kRays>;
using RayInt = IntN<kRays>;

/// An Embree scene with one mesh, built for fast traversal.
class RayMesh {
 public:
  explicit RayMesh(std::shared_ptr<const SphereMesh> mesh);
  ~RayMesh();
  RayMesh(const RayMesh&) = delete;
  RayMesh& operator=(const RayMesh&) = delete;

  /// Returns, for each ray, the index of the first triangle that it hits, or −1. The rays should be coherent. Can be called from multiple
  /// threads at once.
  RayInt first_triangles(const glm::vec3& origin, const vec3<RayReal>& direction) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace halfspace
