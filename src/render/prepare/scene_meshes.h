// SPDX-License-Identifier: Apache-2.0
//
// The meshes of objects with a generated shape, and the reliefs that displace them.
#pragma once

#include <memory>
#include <string>

#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/geometry/height_field.h"
#include "halfspace/geometry/mesh.h"
#include "halfspace/raster/vertex_input.h"
#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/prepare/scene_maps.h"

namespace halfspace::HS_LANES {

// A mesh and its validated indices.
struct MeshAsset {
  explicit MeshAsset(Mesh m) : mesh(std::move(m)), indices(mesh.indices, mesh.positions.size()) {}
  Mesh mesh;
  Indices indices;
};

// The displacement of an object.
struct Relief {
  std::shared_ptr<const HeightField> field;  // null: not displaced
  std::string recipe;
};

// Returns which normals the vertices of a displaced sphere have.
inline ReliefNormals relief_normals(const ObjectDescription& o) {
  return o.normals == NormalSource::undisplaced ? ReliefNormals::undisplaced : ReliefNormals::displaced;
}

class SceneMeshes {
 public:
  // Keeps references to all arguments.
  SceneMeshes(SceneMaps& maps, UsedAssets& used, const Workers& workers) : maps_(maps), used_(used), workers_(workers) {}

  // path: the path of the object, for error messages.
  Relief relief_of(const ObjectDescription& o, const std::string& path);
  std::shared_ptr<const MeshAsset> mesh_of(const ObjectDescription& o, const Relief& relief);

 private:
  std::shared_ptr<const MeshAsset> sphere_of(const ObjectDescription& o, const Relief& relief);

  SceneMaps& maps_;
  UsedAssets& used_;
  const Workers& workers_;
};

}  // namespace halfspace::HS_LANES
