// SPDX-License-Identifier: Apache-2.0
//
// Checks of the state of a draw, for the attachments of its pass. They do not depend on the shader. A failed check is one line.
#pragma once

#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/tile/attachments.h"

namespace halfspace::HS_LANES::detail {

void check_state(const DrawState& state, const Attachments& attachments);

}  // namespace halfspace::HS_LANES::detail
