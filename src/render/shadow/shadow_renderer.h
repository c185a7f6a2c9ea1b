// SPDX-License-Identifier: Apache-2.0
//
// Renders the shadow maps of lights, after all objects have been placed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/shadow/shadow_fit.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

// The shadow of a light, and the maps that it refers to.
struct RenderedShadow {
  Shadow shadow;
  std::shared_ptr<const void> maps;
  PassStatistics statistics;  // sum over the passes that rendered the maps
};

class ShadowRenderer {
 public:
  // Keeps references to all arguments. The shadow method must not be `none`.
  ShadowRenderer(const ShadowDescription& shadow, const View& view, const std::vector<PlacedMesh>& meshes,
                 const std::vector<PlacedSpheres>& spheres, const Workers& workers)
      : shadow_(shadow), view_(view), scene_(shadow_scene(view, meshes, spheres)), workers_(workers) {}

  // Finds views that cover the visible receivers, and renders the depth of the casters into each view. name: of the light, for error
  // messages.
  RenderedShadow render(const std::string& name, const LightDescription& light) const;

 private:
  std::vector<LightView> views(const LightDescription& light, const ShadowSettings& settings, int size) const;
  int resolution(const LightDescription& light, const ShadowSettings& settings) const;

  const ShadowDescription& shadow_;
  const View& view_;
  const ShadowScene scene_;
  const Workers& workers_;
};

}  // namespace halfspace::HS_LANES
