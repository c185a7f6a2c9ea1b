// SPDX-License-Identifier: Apache-2.0
//
// Adds the draws of a prepared scene to a pass.
#pragma once

#include <array>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/shading/values/frame_values.h"

namespace halfspace::HS_LANES {

/// Adds a draw to a pass, with the given state.
void add_draw(Pass& pass, const PreparedDraw& draw, const DrawState& state);

/// Adds a draw to a pass whose attachment n stores FrameValue n. The background and blended surfaces have no values and are omitted.
/// wanted: the values that are needed; the others are undefined.
void add_value_draw(Pass& pass, const PreparedDraw& draw, const FrameCamera& camera, const std::array<bool, kFrameValues>& wanted,
                    const DrawState& state);

}  // namespace halfspace::HS_LANES
