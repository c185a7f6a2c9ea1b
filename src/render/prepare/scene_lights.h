// SPDX-License-Identifier: Apache-2.0
//
// The lights of a scene in the form that shaders read.
#pragma once

#include <span>
#include <vector>

#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

class SceneLights {
 public:
  // Does not keep references to its arguments.
  SceneLights(const SceneDescription& scene, const View& view, UsedAssets& used);

  // Returns the lights that emit diffuse or specular light.
  const std::vector<PreparedLight>& prepared() const { return prepared_; }
  // Returns the shadows of these lights, in the same order. They are empty until they are set.
  std::span<Shadow> shadows() const { return shadows_; }

  // Returns the lights of a surface. For a surface that does not receive shadows, Light::shadow is null.
  LightSet of_surface(bool receives_shadow) const { return receives_shadow ? lights_ : shadowless_lights_; }
  // Returns true if one of these lights has a shadow.
  bool have_shadow(bool receives_shadow) const;
  // Returns the sum of all ambient light.
  const glm::dvec3& ambient() const { return ambient_; }

 private:
  std::vector<PreparedLight> prepared_;
  std::span<Shadow> shadows_;
  LightSet lights_;
  LightSet shadowless_lights_;
  glm::dvec3 ambient_;
};

}  // namespace halfspace::HS_LANES
