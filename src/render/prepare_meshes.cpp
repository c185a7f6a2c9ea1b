// SPDX-License-Identifier: Apache-2.0
//
// Meshes of the scene's objects.
#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/render/preparation.h"
#include "halfspace/scene/shapes.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

// Creates the mesh of a shape. Also specifies how its maps continue beyond their edges.
struct MeshMaker {
  MapEdges edges;
  Mesh (*make)(const ObjectDescription& o, const Displacement* displacement);  // null: the shape has no generated mesh
};

float single(double x) { return static_cast<float>(x); }

Mesh sphere_mesh(const ObjectDescription& o, const Displacement*) { return uv_sphere(o.latitudes, o.longitudes, single(o.radius)); }
Mesh icosphere_mesh(const ObjectDescription& o, const Displacement* d) { return icosphere(o.level, single(o.radius), d); }
Mesh plane_mesh(const ObjectDescription& o, const Displacement* d) { return plane(single(o.size), o.segments, d); }
Mesh cube_mesh(const ObjectDescription& o, const Displacement* d) { return cube(single(o.size), o.segments, d); }
Mesh cylinder_mesh(const ObjectDescription& o, const Displacement* d) {
  return cylinder(single(o.radius), single(o.length), o.latitudes, o.longitudes, d);
}
Mesh cone_mesh(const ObjectDescription& o, const Displacement* d) {
  return cone(single(o.radius), single(o.length), o.latitudes, o.longitudes, d);
}
Mesh torus_mesh(const ObjectDescription& o, const Displacement* d) {
  return torus(single(o.radius), single(o.tube), o.latitudes, o.longitudes, d);
}
Mesh torus_knot_mesh(const ObjectDescription& o, const Displacement* d) {
  return torus_knot(single(o.radius), single(o.tube), o.latitudes, o.longitudes, d);
}

MeshMaker maker_of(Shape shape) {
  switch (shape) {
    case Shape::uv_sphere: return {MapEdges::sphere, sphere_mesh};
    case Shape::icosphere: return {MapEdges::sphere, icosphere_mesh};
    case Shape::plane: return {MapEdges::sheet, plane_mesh};
    case Shape::cube: return {MapEdges::sheet, cube_mesh};
    case Shape::cylinder: return {MapEdges::cylinder, cylinder_mesh};
    case Shape::cone: return {MapEdges::cylinder, cone_mesh};
    case Shape::torus: return {MapEdges::torus, torus_mesh};
    case Shape::torus_knot: return {MapEdges::torus, torus_knot_mesh};
    case Shape::sphere:
    case Shape::file: break;
  }
  return {MapEdges::sheet, nullptr};
}

}  // namespace

MapEdges edges_of(Shape shape) { return maker_of(shape).edges; }

// Returns a displaced uv_sphere. It does not use SurfaceMesh: rows are displaced in parallel, and per-pixel slopes match the
// vertices.
std::shared_ptr<const MeshAsset> ScenePreparation::sphere_of(const ObjectDescription& o, const Relief& relief) {
  const ReliefNormals normals = o.normals == NormalSource::undisplaced ? ReliefNormals::undisplaced : ReliefNormals::displaced;
  const std::string words = recipe("displaced sphere", o.radius, o.latitudes, o.longitudes, relief.recipe, static_cast<int>(normals));
  return used_.asset<MeshAsset>(words, [&] {
    const HeightField filtered = relief.field->filtered(o.longitudes, workers_);
    return MeshAsset(displaced_uv_sphere(o.latitudes, o.longitudes, static_cast<float>(o.radius), filtered, o.height_scale, o.height_zero,
                                         workers_, normals));
  });
}

std::shared_ptr<const MeshAsset> ScenePreparation::mesh_of(const ObjectDescription& o, const Relief& relief) {
  if (o.shape == Shape::uv_sphere && relief.field != nullptr) return sphere_of(o, relief);
  const std::string words = recipe("mesh", static_cast<int>(o.shape), o.radius, o.tube, o.length, o.size, o.latitudes, o.longitudes,
                                   o.level, o.segments, o.tiles_u, o.tiles_v, relief.recipe);
  const auto make = maker_of(o.shape).make;
  return used_.asset<MeshAsset>(words, [&] {
    Mesh mesh;
    if (relief.field != nullptr) {
      const HeightField filtered = relief.field->filtered(kind_of(o).columns(o), workers_);
      const Displacement displacement{&filtered, o.height_scale, o.height_zero};
      mesh = make(o, &displacement);
    } else {
      mesh = make(o, nullptr);
    }
    for (glm::vec2& uv : mesh.uvs) uv *= glm::vec2(o.tiles_u, o.tiles_v);
    return MeshAsset(std::move(mesh));
  });
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
