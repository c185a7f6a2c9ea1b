// SPDX-License-Identifier: Apache-2.0
//
// Provides the shadow maps of lights, after all objects have been placed: those of an earlier frame if nothing has changed for them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/shadow/kept_shadow_maps.h"
#include "halfspace/render/shadow/shadow_fit.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

// The shadow of a light. It refers to the views and to maps among the used assets.
struct RenderedShadow {
  Shadow shadow;
  std::shared_ptr<const std::vector<ShadowView>> views;
  PassStatistics statistics;  // sum over the passes that rendered the maps; zero if the maps are those of an earlier frame
};

class ShadowRenderer {
 public:
  // Keeps references to all arguments. The shadow method must not be `none`.
  ShadowRenderer(const ShadowDescription& shadow, const View& view, const std::vector<PlacedMesh>& meshes,
                 const std::vector<PlacedSpheres>& spheres, UsedAssets& used, const Workers& workers)
      : shadow_(shadow), view_(view), scene_(shadow_scene(view, meshes, spheres)), used_(used), workers_(workers) {
    casters_ = std::make_shared<const ShadowCasters>(casters_of(scene_, used.used()));
  }

  // Finds views that cover the visible receivers, and renders the depth of the casters into each view. name: of the light, for error
  // messages and for the cache.
  RenderedShadow render(const std::string& name, const LightDescription& light);

 private:
  std::vector<LightView> views(const LightDescription& light, const ShadowSettings& settings, int size) const;
  int resolution(const LightDescription& light, const ShadowSettings& settings) const;
  ShadowMaps rendered_maps(const std::string& name, const ShadowMapSource& source, PassStatistics& statistics) const;

  const ShadowDescription& shadow_;
  const View& view_;
  const ShadowScene scene_;
  std::shared_ptr<const ShadowCasters> casters_;
  UsedAssets& used_;
  const Workers& workers_;
};

}  // namespace halfspace::HS_LANES
