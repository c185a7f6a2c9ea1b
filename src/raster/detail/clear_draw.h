// SPDX-License-Identifier: Apache-2.0
//
// Clears of a part of a target between the draws of a pass.
#pragma once

#include "halfspace/raster/clear_values.h"
#include "halfspace/raster/detail/pass_kernels.h"
#include "halfspace/raster/tile/attachments.h"

namespace halfspace::HS_LANES::detail {

/// Checks the values, and adds a draw that sets them. `attachments` are those of the pass.
void add_clear(PassState& state, const Attachments& attachments, const ClearValues& values);

}  // namespace halfspace::HS_LANES::detail
