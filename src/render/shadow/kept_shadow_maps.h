// SPDX-License-Identifier: Apache-2.0
//
// The shadow maps of a light, and what they were made from, so that a later frame can use them again.
#pragma once

#include <memory>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/shadow/shadow_fit.h"
#include "halfspace/render/shadow/shadow_views.h"

namespace halfspace::HS_LANES {

/// Everything that the texels of a light's shadow maps depend on.
struct ShadowMapSource {
  std::vector<LightView> views;
  int size = 0;         ///< of each map, in texels
  int mean_radius = 0;  ///< of the moments; 0 for other filters
  ShadowFaces faces{};
  ShadowFilter filter{};
  std::vector<PlacedMesh> meshes;  ///< that cast shadows
  std::vector<std::shared_ptr<const Particles>> spheres;
};

struct ShadowMaps {
  std::vector<Image<float>> depths, block_depths;  ///< one per view; block depths only for filters that use them
  std::vector<Image<glm::vec4>> moments;           ///< one per view, for filters that use them
};

/// The maps of the last frame.
struct KeptShadowMaps {
  std::shared_ptr<const ShadowMaps> maps;
  ShadowMapSource source;
  /// The assets of the last frame. While they exist, no other asset can have the address of one of the source's.
  std::vector<std::shared_ptr<const void>> assets;
};

/// Adds what casts shadows in a scene to a source.
void add_casters(const ShadowScene& scene, ShadowMapSource& source);

/// Returns true if both sources have the same maps. Meshes and textures are compared by their addresses, and spheres by their values,
/// because they are made anew for each frame.
bool have_same_maps(const ShadowMapSource& a, const ShadowMapSource& b);

}  // namespace halfspace::HS_LANES
