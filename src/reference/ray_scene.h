// SPDX-License-Identifier: Apache-2.0
//
// The triangles of a scene, to be asked by rays: the truth that pictures are held against. Embree does the work (the only
// place that includes it; version 3.13 and 4), with its robust mode: rays do not slip between triangles.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// Where a ray meets the scene. The suffix _rws: the world's axes, RaySceneOptions::eye_ws as origin.
struct RayHit {
  int mesh;                       ///< index into the meshes given; −1, −2, …: a sphere of the first spheres given, of the second, …
  uint32_t triangle;              ///< of that mesh: its indices are 3·triangle …; or the sphere's number among those
  float distance;                 ///< along the ray, in lengths of its direction
  std::array<double, 3> weights;  ///< barycentric, of the triangle's vertices; they add up to 1. Of a sphere 0
  glm::dvec3 position_rws;        ///< by the weights, in double: nearer to the triangle than origin + distance·direction
  glm::dvec3 face_normal_ws;      ///< unit; the triangle's, counter-clockwise in front
};

/// Immutable; any number of threads may ask at once.
class RayScene {
 public:
  /// Takes a copy of the meshes' triangles in world space round eye_ws, as floats. With casters_only, only of those that
  /// cast shadows; indices stay those of `meshes`.
  /// Spheres are Embree's own.
  RayScene(std::span<const PlacedMesh> meshes, const glm::dvec3& eye_ws, bool casters_only = false,
           std::span<const PlacedSpheres> spheres = {});
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// The nearest triangle, seen from either side, on origin + t·direction, near ≤ t ≤ far.
  std::optional<RayHit> nearest(const glm::vec3& origin_rws, const glm::vec3& direction_ws, float near, float far) const;

  /// Is there any triangle on origin + t·direction, near ≤ t ≤ far?
  bool occluded(const glm::vec3& origin_rws, const glm::vec3& direction_ws, float near, float far) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace halfspace
