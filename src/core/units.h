// SPDX-License-Identifier: Apache-2.0
//
// Unit conversion factors.
#pragma once

#include <numbers>

namespace halfspace {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

}  // namespace halfspace
