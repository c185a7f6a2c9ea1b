// SPDX-License-Identifier: Apache-2.0
//
// The appearance of objects that have a surface in the scene description.
#pragma once

#include <string>

#include "halfspace/render/assets/warnings.h"
#include "halfspace/render/prepare/scene_environments.h"
#include "halfspace/render/prepare/scene_lights.h"
#include "halfspace/render/prepare/scene_maps.h"
#include "halfspace/render/view.h"
#include "halfspace/shading/surface/lit_surface.h"

namespace halfspace::HS_LANES {

class SceneSurfaces {
 public:
  // Keeps references to all arguments.
  SceneSurfaces(const SceneDescription& scene, const View& view, const SceneLights& lights, SceneMaps& maps,
                SceneEnvironments& environments, Warnings& warnings)
      : scene_(scene), view_(view), lights_(lights), maps_(maps), environments_(environments), warnings_(warnings) {}

  // Returns the surface of an object without its transforms and without a map for per-pixel normals. path: the path of the object, for
  // error messages.
  LitSurface surface_of(const ObjectDescription& o, const std::string& path);
  // Returns the ambient light of a surface with this factor: that of the lights and the scene, and of the environment if one is named.
  glm::dvec3 ambient(const Color& factor);

 private:
  void add_factor(LitSurface& s, MaterialFactor factor, const glm::dvec3& constant, const MapValue& map, const ObjectDescription& o,
                  const std::string& where);
  void report_unused_maps(const ObjectDescription& o, const std::string& path);

  const SceneDescription& scene_;
  const View& view_;
  const SceneLights& lights_;
  SceneMaps& maps_;
  SceneEnvironments& environments_;
  Warnings& warnings_;
};

}  // namespace halfspace::HS_LANES
