// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenes/scene_shape.h"

namespace halfspace {

/// Reorders triangles and vertices like the meshes of 3D scanners, which are extracted cell by cell from an octree: triangles by the cell
/// of their center, in Morton order on a grid of 64³ cells, and vertices by their first use. Triangles of one cell keep their order.
void order_by_cells(SceneShape& shape);

}  // namespace halfspace
