// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/shadow/sphere_camera.h"

namespace halfspace::HS_LANES {

namespace {

glm::dvec3 row(const glm::dmat4& m, int i) { return {m[0][i], m[1][i], m[2][i]}; }

}  // namespace

// The rows of a rotation have unit length and clip x = x / half.x, so the length of the clip x row is 1 / half.x. Likewise for y.
SphereCamera::SphereCamera(const glm::dmat4& clip_from_world, double near, double far)
    : clip_from_world_(clip_from_world),
      perspective_(row(clip_from_world, 3) != glm::dvec3(0.0)),
      half_(1.0 / glm::length(row(clip_from_world, 0)), 1.0 / glm::length(row(clip_from_world, 1))),
      near_(near),
      far_(far) {}

std::vector<glm::vec3> SphereCamera::centers_cs(const Particles& spheres) const {
  std::vector<glm::vec3> centers;
  centers.reserve(spheres.centers_ws.size());
  for (const glm::dvec3& center_ws : spheres.centers_ws) {
    const glm::dvec4 clip = clip_from_world_ * glm::dvec4(center_ws, 1.0);
    const double z = perspective_ ? clip.w : near_ + (1.0 - clip.z) * (far_ - near_);
    centers.emplace_back(clip.x * half_.x, clip.y * half_.y, z);
  }
  return centers;
}

}  // namespace halfspace::HS_LANES
