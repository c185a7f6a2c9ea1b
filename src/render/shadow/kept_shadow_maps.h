// SPDX-License-Identifier: Apache-2.0
//
// The shadow maps of a light, and what they were made from, so that the next frame can use them again.
#pragma once

#include <memory>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/shadow/shadow_fit.h"
#include "halfspace/render/shadow/shadow_views.h"

namespace halfspace::HS_LANES {

/// The objects of a frame that cast shadows.
struct ShadowCasters {
  std::vector<PlacedMesh> meshes;
  std::vector<std::shared_ptr<const Particles>> spheres;
  /// The assets of the frame, if a mesh has maps of its opacity. While they exist, no other map can have the address of one of these.
  std::vector<std::shared_ptr<const void>> assets;
};

/// Returns the casters of a scene. assets: what the scene uses.
ShadowCasters casters_of(const ShadowScene& scene, const std::vector<std::shared_ptr<const void>>& assets);

/// Everything that the texels of a light's shadow maps depend on.
struct ShadowMapSource {
  std::vector<LightView> views;
  int size = 0;         ///< of each map, in texels
  int mean_radius = 0;  ///< of the moments; 0 for other filters
  ShadowFaces faces{};
  ShadowFilter filter{};
  std::shared_ptr<const ShadowCasters> casters;
};

/// Returns true if both sources have the same maps. Meshes and textures are compared by their addresses. Exact spheres are made anew for
/// each frame, and compared by their values. Deformed meshes are different in each frame, even in the same pose.
bool have_same_maps(const ShadowMapSource& a, const ShadowMapSource& b);

struct ShadowMaps {
  std::vector<Image<float>> depths, block_depths;  ///< one per view; block depths only for filters that use them
  std::vector<Image<glm::vec4>> moments;           ///< one per view, for filters that use them
};

/// The maps of the last frame.
struct KeptShadowMaps {
  std::shared_ptr<const ShadowMaps> maps;
  ShadowMapSource source;
};

}  // namespace halfspace::HS_LANES
