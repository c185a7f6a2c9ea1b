// SPDX-License-Identifier: Apache-2.0
//
// Draws spheres as points, many per draw call: particle systems and objects of shape `sphere`.
#pragma once

#include <string>

#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/particles.h"
#include "halfspace/render/prepare/scene_draws.h"
#include "halfspace/render/prepare/scene_lights.h"
#include "halfspace/render/prepare/scene_surfaces.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

class SpherePreparation {
 public:
  // Keeps references to all arguments.
  SpherePreparation(const SceneDescription& scene, const View& view, const SceneLights& lights, SceneSurfaces& surfaces, UsedAssets& used,
                    SceneDraws& draws)
      : scene_(scene), view_(view), lights_(lights), surfaces_(surfaces), used_(used), draws_(draws) {}

  // object: index for DrawSource::object. path: the path of the object or the particle system, for error messages.
  void add(int object, const std::string& path, const ObjectDescription& o);
  void add_particles(int object, const std::string& path, const ParticlesDescription& p);

 private:
  SphereImpostors impostors(bool receives_shadow) const;
  void draw(int object, const Particles& spheres, const glm::dvec3& color, const SceneShader& shader);

  const SceneDescription& scene_;
  const View& view_;
  const SceneLights& lights_;
  SceneSurfaces& surfaces_;
  UsedAssets& used_;
  SceneDraws& draws_;
};

}  // namespace halfspace::HS_LANES
