// SPDX-License-Identifier: Apache-2.0
//
// Assigns lights of limited reach to cells of the window.
#pragma once

#include <memory>
#include <span>

#include "halfspace/render/view.h"
#include "halfspace/shading/light/light_set.h"

namespace halfspace::HS_LANES {

/// Returns, for each cell of the window, the lights that can reach a surface seen in it. A light reaches a ball around its position or, if
/// it is a spot light, the part of that ball within its cone. A cell sees the part of space between four planes through its sides. A light
/// is omitted from a cell if it lies entirely behind one of these planes; so no light that reaches the cell is omitted. Returns null if
/// fewer than kManyLights lights have a limited reach.
std::shared_ptr<const LightCells> light_cells(const View& view, std::span<const Light> lights);

/// With fewer lights, a list per cell would save little.
inline constexpr std::size_t kManyLights = 8;

}  // namespace halfspace::HS_LANES
