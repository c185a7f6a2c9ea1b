// SPDX-License-Identifier: Apache-2.0
//
// Finds the shadow map views of a light that are needed for an image. There are none if nothing visible receives its shadow.
#pragma once

#include <array>
#include <vector>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/shadow/shadow_views.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

/// A mesh or a set of spheres, and its bounds. One of the two pointers is null. Not owned.
struct ShadowExtent {
  const PlacedMesh* mesh;
  const PlacedSpheres* spheres;
  Box box_ws;
  bool casts_shadow, receives_shadow;
};

/// What the shadows of all lights have in common: the objects, and the view in which shadows are seen.
struct ShadowScene {
  std::vector<ShadowExtent> objects;
  std::array<glm::dvec3, 8> frustum_ws;  ///< corners, see frustum_corners
  glm::dvec3 eye_ws, forward_ws;
};

/// Refers to the meshes and spheres.
ShadowScene shadow_scene(const View& view, const std::vector<PlacedMesh>& meshes, const std::vector<PlacedSpheres>& spheres);

/// Returns true if the box is entirely outside one of the six planes of a view volume.
bool is_outside(const glm::dmat4& clip_from_world, const Box& box_ws);

/// Returns the views for maps of size² texels, with `margin` texels around each view for filtering. A directional light has
/// one view per cascade that shows a receiver. A spot light has one view. A point light, or a spot light with an outer angle above
/// 60 degrees, has one view per cube face that contains a receiver and a caster. Objects beyond the range of the light do not count.
std::vector<LightView> fitted_views(const ShadowScene& scene, const LightDescription& light, const ShadowDescription& shadow, int size,
                                    double margin);

}  // namespace halfspace::HS_LANES
