// SPDX-License-Identifier: Apache-2.0
//
// Closed-form sculptures with as many triangles as a 3D scan. They stand on y = 0 and face +z; triangles are ordered by order_by_cells().
#pragma once

#include "scenes/scene_shape.h"

namespace halfspace {

/// A draped figure with one raised arm, 1.9 units high. The number of triangles differs from `triangles` by at most 1%.
SceneShape statue(int triangles);
/// A head on a base, 1 unit high.
SceneShape bust(int triangles);
/// A vase with flutes and bands in relief, 1 unit high.
SceneShape vase(int triangles);
/// A weathered rock, about 1 unit high.
SceneShape boulder(int triangles);
/// A snail's shell, about 1 unit high.
SceneShape shell(int triangles);

}  // namespace halfspace
