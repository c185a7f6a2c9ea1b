// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/geometry/height_field.h"

namespace halfspace::HS_LANES {

/// Returns the tangent-space normal map of a map of heights in [0, 1], with red along u and green up. A height of 1 corresponds to
/// `strength` texels. With x to the right and y down, in texels,
///
///   n = normalize(−strength · ∂h/∂x, strength · ∂h/∂y, 1)      texel = (n/2 + 1/2) · 255, rounded
///
/// The slopes equal HeightField's at the texel centers: central differences, averaged across with weights 1/6, 4/6, 1/6. So
/// ∂h/∂x = Σ w_k · (h(x + 1, y + k) − h(x − 1, y + k)) / 2, and likewise for y. `edges` selects the continuation beyond the edges.
/// `heights` must be at least two texels wide and one high.
Image<glm::u8vec4> normal_map(const Image<float>& heights, double strength, MapEdges edges, const Workers& workers);

}  // namespace halfspace::HS_LANES
