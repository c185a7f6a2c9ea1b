// SPDX-License-Identifier: Apache-2.0
//
// `halfspace validate --table`: what each way of biasing and filtering a shadow map is worth, on four scenes: error beside time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "halfspace/reference/validation.h"

namespace halfspace {

/// One way of making a scene's shadows.
struct ShadowCase {
  std::string factor;  ///< what is varied: bias, filter, resolution, angle, or all of a full grid
  std::string scene, bias, method;
  int resolution;
  double angle;  ///< degrees between the light and the vertical
  SceneDescription description;
};

/// One factor at a time around the automatic settings (pcf3, auto, 2048), or with `full` every combination of bias, filter,
/// resolution and angle, on four scenes. Lights' sizes are 0: the truth is hard.
void for_each_shadow_case(bool full, const std::function<void(const ShadowCase&)>& visit);

/// One row: what was varied, and how it did.
struct TableRow {
  std::string factor;  ///< bias, filter, resolution, angle, or all of a full grid
  double angle;        ///< degrees between the light and the vertical
  ShadowScore score;
};

/// Judges every case. Each row is handed to `done` when it is known.
std::vector<TableRow> shadow_table(bool full, const ValidationOptions& options, const Workers& workers,
                                   const std::function<void(const TableRow&)>& done);

/// The rows with a line of names, as CSV; errors as fractions.
std::string csv_header();
std::string csv_line(const TableRow& row);

}  // namespace halfspace
