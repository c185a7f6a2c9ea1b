// SPDX-License-Identifier: Apache-2.0
//
// Minimum sizes of generated maps and environments. They keep the sizes constant over a range of frames.
#pragma once

#include <map>
#include <string>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Sizes of generated environments, in texels.
struct EnvironmentSizes {
  int panorama_width = 0, face = 0;
};

/// The minimum sizes of a scene, in texels.
struct MinimumSizes {
  std::map<std::string, int> map_widths;  ///< by object name
  EnvironmentSizes environments;
};

}  // namespace halfspace::HS_LANES
