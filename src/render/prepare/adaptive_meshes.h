// SPDX-License-Identifier: Apache-2.0
//
// Meshes of generated shapes that adapt to the view (mesh_error, docs/explanation/max_error.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "halfspace/geometry/adaptive_mesh.h"
#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/prepare/scene_maps.h"
#include "halfspace/render/prepare/scene_meshes.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

// Each decision about a triangle looks at all copies of the object.
inline constexpr std::size_t kMaxAdaptiveCopies = 64;

// A mesh that was made for a view.
struct FittedMesh {
  FittedMesh(Mesh mesh, const SimplifiedObject& counts) : asset(std::move(mesh)), report(counts) {}

  MeshAsset asset;
  SimplifiedObject report;  // without the index of the object
};

class AdaptiveMeshes {
 public:
  // Keeps references to all arguments.
  AdaptiveMeshes(const View& view, SceneMaps& maps, UsedAssets& used, const Workers& workers)
      : view_(view), maps_(maps), used_(used), workers_(workers) {}

  // Returns the mesh of a uv_sphere, plane, torus or torus_knot in which every copy is off by at most mesh_error pixels. places: the
  // world-from-object transforms of its copies; InputError if there are more than kMaxAdaptiveCopies. casts: it casts shadows. where: the
  // path of the object, for error messages.
  std::shared_ptr<const FittedMesh> mesh_of(const ObjectDescription& o, const Relief& relief, const std::vector<glm::dmat4>& places,
                                            bool casts, const std::string& where);

 private:
  const View& view_;
  SceneMaps& maps_;
  UsedAssets& used_;
  const Workers& workers_;
};

}  // namespace halfspace::HS_LANES
