// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/scene_meshes.h"

#include "halfspace/render/prepare/shape_mesh.h"
#include "halfspace/scene/shapes.h"

namespace halfspace::HS_LANES {

Relief SceneMeshes::relief_of(const ObjectDescription& o, const std::string& path) {
  if (!is_map(o.height)) return {};
  const MapUse use = maps_.use_of(o.height, o);
  Relief r;
  r.field = maps_.height_field(use, o, path + ".height");
  r.recipe = recipe(static_cast<int>(use.texture.source), use.texture.file.path.string(), use.width, o.height_smoothing, o.height_scale,
                    o.height_zero);
  return r;
}

// Returns a displaced uv_sphere. It does not use SurfaceMesh: rows are displaced in parallel, and per-pixel slopes match the
// vertices.
std::shared_ptr<const MeshAsset> SceneMeshes::sphere_of(const ObjectDescription& o, const Relief& relief) {
  const ReliefNormals normals = relief_normals(o);
  const std::string words = recipe("displaced sphere", o.radius, o.latitudes, o.longitudes, relief.recipe, static_cast<int>(normals));
  return used_.asset<MeshAsset>(words, [&] {
    const HeightField filtered = relief.field->filtered(o.longitudes, workers_);
    return MeshAsset(displaced_uv_sphere(o.latitudes, o.longitudes, static_cast<float>(o.radius), filtered, o.height_scale, o.height_zero,
                                         workers_, normals));
  });
}

std::shared_ptr<const MeshAsset> SceneMeshes::mesh_of(const ObjectDescription& o, const Relief& relief) {
  if (o.shape == Shape::uv_sphere && relief.field != nullptr) return sphere_of(o, relief);
  const std::string words = recipe("mesh", static_cast<int>(o.shape), o.radius, o.tube, o.length, o.size, o.latitudes, o.longitudes,
                                   o.level, o.segments, o.tiles_u, o.tiles_v, relief.recipe);
  return used_.asset<MeshAsset>(words, [&] {
    Mesh mesh;
    if (relief.field != nullptr) {
      const HeightField filtered = relief.field->filtered(kind_of(o).columns(o), workers_);
      const Displacement displacement{&filtered, o.height_scale, o.height_zero};
      mesh = shape_mesh(o, &displacement);
    } else {
      mesh = shape_mesh(o, nullptr);
    }
    for (glm::vec2& uv : mesh.uvs) uv *= glm::vec2(o.tiles_u, o.tiles_v);
    return MeshAsset(std::move(mesh));
  });
}

}  // namespace halfspace::HS_LANES
