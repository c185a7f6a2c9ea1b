// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/geometry/height_field.h"

namespace halfspace {

/// A normal map in tangent space, red along u, green up, of a map of heights in [0, 1] that reach `strength` texels from 0 to 1.
/// With x to the right and y down, in texels,
///
///   n = normalize(−strength · ∂h/∂x, strength · ∂h/∂y, 1)      code = (n/2 + 1/2) · 255, rounded
///
/// The slopes are those of HeightField's surface at the texels' centres, central differences averaged across with weights
/// 1/6, 4/6, 1/6: ∂h/∂x = Σ w_k · (h(x + 1, y + k) − h(x − 1, y + k)) / 2, likewise by y. `edges` tells what lies beyond the
/// edges. heights: at least two texels wide and one high.
Image<glm::u8vec4> normal_map(const Image<float>& heights, double strength, MapEdges edges, const Workers& workers);

}  // namespace halfspace
