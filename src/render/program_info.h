// SPDX-License-Identifier: Apache-2.0
//
// Describes this build and the tools that it found.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns the version, the instruction set, the lanes, the compiler, the number of CPUs that it can use, and the paths of the decoders,
/// which are null if they were not found.
nlohmann::ordered_json program_info(const std::string& version);

}  // namespace halfspace::HS_LANES
