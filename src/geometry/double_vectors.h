// SPDX-License-Identifier: Apache-2.0
//
// Vectors in double whose bits are the same on every machine.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace halfspace {

/// v / |v|, correctly rounded step by step; GLM multiplies by an inverse square root instead. v is not zero.
inline glm::dvec3 unit(const glm::dvec3& v) { return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// In float, without negative zeros, so that equal vectors have equal bits.
inline glm::vec3 rounded(const glm::dvec3& v) { return glm::vec3(v + 0.0); }

}  // namespace halfspace
