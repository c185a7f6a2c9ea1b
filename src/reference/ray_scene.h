// SPDX-License-Identifier: Apache-2.0
//
// Casts rays against the triangles of a scene. The results are the reference for rendered images. This is a wrapper around Embree (versions
// 3.13 and 4) in its robust mode, in which rays do not slip between adjacent triangles.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// The point where a ray hits the scene. Suffix _rws: relative to the eye_ws passed to RayScene, with the axes of world space.
struct RayHit {
  int mesh;                       ///< index of the mesh; −1, −2, … for the first, second, … set of spheres
  uint32_t triangle;              ///< index of the triangle in the mesh, or of the sphere in its set
  float distance;                 ///< ray parameter t, in multiples of the direction's length
  std::array<double, 3> weights;  ///< barycentric coordinates, which add up to 1; all 0 for a sphere
  glm::dvec3 position_rws;        ///< for triangles, interpolated in double, so more accurate than origin + distance·direction
  glm::dvec3 face_normal_ws;      ///< geometric unit normal; points to the side from which a triangle is counter-clockwise
};

/// Immutable after construction; can be queried from multiple threads at once.
class RayScene {
 public:
  /// Copies the triangles, in world space relative to eye_ws and rounded to float. With casters_only, meshes and spheres that cast no
  /// shadow are omitted; this does not change the indices in RayHit. Spheres become sphere primitives of Embree.
  RayScene(std::span<const PlacedMesh> meshes, const glm::dvec3& eye_ws, bool casters_only = false,
           std::span<const PlacedSpheres> spheres = {});
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// Returns the nearest hit on origin + t·direction with near ≤ t ≤ far. Triangles are two-sided.
  std::optional<RayHit> nearest(const glm::vec3& origin_rws, const glm::vec3& direction_ws, float near, float far) const;

  /// Returns true if anything is hit on origin + t·direction with near ≤ t ≤ far.
  bool occluded(const glm::vec3& origin_rws, const glm::vec3& direction_ws, float near, float far) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace halfspace::HS_LANES
