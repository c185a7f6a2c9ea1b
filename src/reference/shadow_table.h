// SPDX-License-Identifier: Apache-2.0
//
// `halfspace validate --table`: measures the error and time of every shadow map bias and filter on four scenes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "halfspace/reference/validation.h"

namespace halfspace::HS_LANES {

/// One combination of scene and shadow settings.
struct ShadowCase {
  std::string factor;  ///< the factor that is varied (bias, filter, resolution, angle), or "all" in a full grid
  std::string scene, bias, method;
  int resolution;
  double angle;  ///< between the light and the vertical, in degrees
  SceneDescription description;
};

/// Calls `visit` for each case on four scenes. Varies one factor at a time around the default settings (pcf3, auto, 2048); with `full`,
/// visits every combination of bias, filter, resolution and angle. Lights have size 0, so the reference shadows are hard.
void for_each_shadow_case(bool full, const std::function<void(const ShadowCase&)>& visit);

/// One row of the table.
struct TableRow {
  std::string factor;  ///< see ShadowCase::factor
  double angle;        ///< between the light and the vertical, in degrees
  ShadowScore score;
};

/// Scores every case. Calls `done` with each row as soon as it is complete.
std::vector<TableRow> shadow_table(bool full, const ValidationOptions& options, const Workers& workers,
                                   const std::function<void(const TableRow&)>& done);

/// The header line and one line of the table as CSV. Errors are fractions, not percentages.
std::string csv_header();
std::string csv_line(const TableRow& row);

}  // namespace halfspace::HS_LANES
