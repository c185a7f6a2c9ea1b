// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

// What the objects and particles of a scene draw.
struct SceneDraws {
  std::vector<PreparedDraw> opaque, blended;  // blended surfaces are drawn after everything opaque
  std::vector<PreparedDraw> normals;          // lines of normals are drawn after the opaque surfaces
  std::vector<PlacedMesh> meshes;
  std::vector<PlacedSpheres> spheres;
  std::vector<SimplifiedObject> simplified;
  bool needs_light = false;  // whether a surface has been added that is black without light

  void add(PreparedDraw draw) { (draw.state.order_independent ? blended : opaque).push_back(std::move(draw)); }
};

}  // namespace halfspace::HS_LANES
