// SPDX-License-Identifier: Apache-2.0
//
// Meshes of the scene's objects.
#include <algorithm>

#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/render/preparation.h"

namespace halfspace {

namespace {

Mesh generated(const ObjectDescription& o, const Displacement* displacement) {
  const auto radius = static_cast<float>(o.radius), tube = static_cast<float>(o.tube), length = static_cast<float>(o.length);
  const auto size = static_cast<float>(o.size);
  switch (o.shape) {
    case Shape::uv_sphere: return uv_sphere(o.latitudes, o.longitudes, radius);
    case Shape::icosphere: return icosphere(o.level, radius, displacement);
    case Shape::plane: return plane(size, o.segments, displacement);
    case Shape::cube: return cube(size, o.segments, displacement);
    case Shape::cylinder: return cylinder(radius, length, o.latitudes, o.longitudes, displacement);
    case Shape::cone: return cone(radius, length, o.latitudes, o.longitudes, displacement);
    case Shape::torus: return torus(radius, tube, o.latitudes, o.longitudes, displacement);
    case Shape::sphere:
    case Shape::file:
    case Shape::torus_knot: break;
  }
  return torus_knot(radius, tube, o.latitudes, o.longitudes, displacement);
}

}  // namespace

// Height maps with more columns are box filtered to this width.
int columns_of(const ObjectDescription& o) {
  switch (o.shape) {
    case Shape::plane:
    case Shape::cube: return std::max(o.segments, 2);
    case Shape::icosphere: return 5 << o.level;
    default: return o.longitudes;
  }
}

MapEdges edges_of(Shape shape) {
  switch (shape) {
    case Shape::uv_sphere:
    case Shape::icosphere: return MapEdges::sphere;
    case Shape::torus:
    case Shape::torus_knot: return MapEdges::torus;
    case Shape::cylinder:
    case Shape::cone: return MapEdges::cylinder;
    default: return MapEdges::sheet;
  }
}

// Returns a displaced uv_sphere. It does not use SurfaceMesh: rows are displaced in parallel, and per-pixel slopes match the
// vertices.
std::shared_ptr<const MeshAsset> ScenePreparation::sphere_of(const ObjectDescription& o, const Relief& relief) {
  const ReliefNormals normals = o.normals == NormalSource::undisplaced ? ReliefNormals::undisplaced : ReliefNormals::displaced;
  return asset<MeshAsset>(recipe("displaced sphere", o.radius, o.latitudes, o.longitudes, relief.recipe, static_cast<int>(normals)), [&] {
    const HeightField filtered = relief.field->filtered(o.longitudes, assets_.workers_);
    return MeshAsset(displaced_uv_sphere(o.latitudes, o.longitudes, static_cast<float>(o.radius), filtered, o.height_scale, o.height_zero,
                                         assets_.workers_, normals));
  });
}

std::shared_ptr<const MeshAsset> ScenePreparation::mesh_of(const ObjectDescription& o, const Relief& relief) {
  if (o.shape == Shape::uv_sphere && relief.field != nullptr) return sphere_of(o, relief);
  const std::string words = recipe("mesh", static_cast<int>(o.shape), o.radius, o.tube, o.length, o.size, o.latitudes, o.longitudes,
                                   o.level, o.segments, o.tiles_u, o.tiles_v, relief.recipe);
  return asset<MeshAsset>(words, [&] {
    Mesh mesh;
    if (relief.field != nullptr) {
      const HeightField filtered = relief.field->filtered(columns_of(o), assets_.workers_);
      const Displacement displacement{&filtered, o.height_scale, o.height_zero};
      mesh = generated(o, &displacement);
    } else {
      mesh = generated(o, nullptr);
    }
    for (glm::vec2& uv : mesh.uvs) uv *= glm::vec2(o.tiles_u, o.tiles_v);
    return MeshAsset(std::move(mesh));
  });
}

}  // namespace halfspace
