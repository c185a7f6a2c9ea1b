// SPDX-License-Identifier: Apache-2.0
//
// Unit conversion factors.
#pragma once

#include <numbers>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

}  // namespace halfspace::HS_LANES
