// SPDX-License-Identifier: Apache-2.0
//
// A mesh that packets of rays are shot at, by Embree (3.13 or 4). The only place of the benchmark that includes it.
#pragma once

#include <memory>

#include "halfspace/core/lanes.h"
#include "halfspace/core/vec.h"
#include "workload_assets.h"

namespace halfspace {

/// As many rays at once as the build has lanes, at least four.
inline constexpr int kRays = kLanes >= 4 ? kLanes : 4;
using RayReal = RealN<kRays>;
using RayInt = IntN<kRays>;

/// An Embree scene of one mesh, built for fast tracing.
class RayMesh {
 public:
  explicit RayMesh(std::shared_ptr<const SphereMesh> mesh);
  ~RayMesh();
  RayMesh(const RayMesh&) = delete;
  RayMesh& operator=(const RayMesh&) = delete;

  /// For each ray from origin along its direction the number of the first triangle it meets, or −1. The rays are close together.
  /// Any number of threads may ask at once.
  RayInt first_triangles(const glm::vec3& origin, const vec3<RayReal>& direction) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace halfspace
