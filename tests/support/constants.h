// SPDX-License-Identifier: Apache-2.0
//
// Numeric constants shared by tests.
#pragma once

#include <limits>
#include <numbers>

namespace halfspace {

inline constexpr double kPi = std::numbers::pi;
inline constexpr float kInf = std::numeric_limits<float>::infinity();
inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

}  // namespace halfspace
