// SPDX-License-Identifier: Apache-2.0
//
// Comparison operators of the depth test, the stencil test and depth textures.
#pragma once

#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

enum class CompareOp : uint8_t { never, less, equal, less_equal, greater, not_equal, greater_equal, always };

}  // namespace halfspace::HS_LANES
