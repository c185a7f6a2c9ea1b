// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Returns a sentence that suggests --up-axis z if the bounds of an OBJ or PLY model, whose formats do not say which axis points up, make
/// it likely; empty otherwise. Either of these is likely only if z points up:
/// - The model stands on z = 0, but y = 0 is in its middle: z begins within 10 % of the height from 0, and y extends to both sides of 0 by
///   at least a fifth of its range. The height is at least 2 % of the larger side; a flatter model may be a panel that faces the viewer.
/// - x and y are map coordinates, and z is not: x and y are beyond 10,000 and 10 times the size of the model, and z is below a tenth of
/// both.
std::string up_axis_hint(const Model& model);

}  // namespace halfspace::HS_LANES
