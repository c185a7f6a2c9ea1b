// SPDX-License-Identifier: Apache-2.0
//
// Double-precision vector functions whose results are bit-identical on every machine.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns v / |v|, with every step correctly rounded. (GLM multiplies by an inverse square root instead.) v must not be zero.
inline glm::dvec3 unit(const glm::dvec3& v) { return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// Converts to float and turns negative zeros into positive ones, so that equal vectors have equal bits.
inline glm::vec3 rounded(const glm::dvec3& v) { return glm::vec3(v + 0.0); }

}  // namespace halfspace::HS_LANES
