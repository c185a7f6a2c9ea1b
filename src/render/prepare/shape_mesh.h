// SPDX-License-Identifier: Apache-2.0
//
// The generated meshes of shapes.
#pragma once

#include "halfspace/geometry/height_field.h"
#include "halfspace/geometry/mesh.h"
#include "halfspace/geometry/surface_mesh.h"
#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// Returns how a map continues beyond its edges on a shape.
MapEdges edges_of(Shape shape);

/// Returns the mesh of an object whose shape has one (not `sphere` or `file`). displacement: null if the object is not displaced. A
/// displaced uv_sphere has its own function, displaced_uv_sphere.
Mesh shape_mesh(const ObjectDescription& o, const Displacement* displacement);

}  // namespace halfspace::HS_LANES
