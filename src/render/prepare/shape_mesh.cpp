// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/shape_mesh.h"

#include "halfspace/geometry/shapes.h"

namespace halfspace::HS_LANES {

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

Mesh shape_mesh(const ObjectDescription& o, const Displacement* displacement) { return maker_of(o.shape).make(o, displacement); }

}  // namespace halfspace::HS_LANES
