// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "halfspace/raster/statistics.h"
#include "halfspace/render/model/model_choice.h"

namespace halfspace {

/// What --stats tells of a rendered picture.
struct RenderReport {
  std::string scene, output;
  int width = 0, height = 0, threads = 0;
  double render_ms = 0;  ///< maps read or made, and the passes
  double write_ms = 0;   ///< encoding and writing
  PassStatistics counts;
  std::vector<ModelChoice> choices;  ///< of the last picture
};

/// One "name value" a line.
std::string text_report(const RenderReport& report);

/// One JSON object.
std::string json_report(const RenderReport& report);

}  // namespace halfspace
