// SPDX-License-Identifier: Apache-2.0
//
// Finds vertices with equal positions.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns for every position the index of the first position that is equal to it. 0 and −0 are equal. Positions must be finite.
std::vector<uint32_t> position_ids(std::span<const glm::vec3> positions);

}  // namespace halfspace::HS_LANES
