// SPDX-License-Identifier: Apache-2.0
//
// The maps that provide the per-pixel normals of objects.
#pragma once

#include <string>

#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/prepare/scene_maps.h"
#include "halfspace/render/prepare/scene_meshes.h"
#include "halfspace/shading/surface/surface_shader.h"

namespace halfspace::HS_LANES {

class DetailMaps {
 public:
  // Keeps references to all arguments.
  DetailMaps(SceneMaps& maps, UsedAssets& used, const Workers& workers) : maps_(maps), used_(used), workers_(workers) {}

  // Sets the map that provides an object's per-pixel normals, if there is one. path: the path of the object, for error messages.
  NormalDetail add_detail(LitSurface& s, const ObjectDescription& o, const Relief& relief, const std::string& path);

 private:
  DetailMap normal_map(const ObjectDescription& o, const std::string& where);
  DetailMap bump_map(const ObjectDescription& o, const std::string& where);
  DetailMap slopes_of(const Relief& relief, const ObjectDescription& o);

  SceneMaps& maps_;
  UsedAssets& used_;
  const Workers& workers_;
};

}  // namespace halfspace::HS_LANES
