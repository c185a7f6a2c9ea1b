// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "halfspace/raster/statistics.h"
#include "halfspace/render/model/model_choice.h"

namespace halfspace {

/// The data that --stats prints.
struct RenderReport {
  std::string scene, output;
  int width = 0, height = 0, threads = 0;
  double render_ms = 0;  ///< loading or generating maps, and rendering
  double write_ms = 0;   ///< encoding and writing the images
  PassStatistics counts;
  bool spheres_without_wireframe = false;
  std::vector<ModelChoice> choices;  ///< settings chosen by --max-error for the last image
};

/// Formats the report as lines of name and value.
std::string text_report(const RenderReport& report);

/// Formats the report as a JSON object.
std::string json_report(const RenderReport& report);

}  // namespace halfspace
