// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/naive_picture.h"
#include "halfspace/raster/statistics.h"
#include "halfspace/render/error_budget/approximation_choice.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// What model_error or mesh_error has simplified.
struct SimplifiedModel {
  std::string name;  ///< of the object
  double allowed_px = 0.0;
  SimplifiedObject counts;
};

/// The data that --stats prints.
struct RenderReport {
  std::string scene, output;
  int width = 0, height = 0, threads = 0;
  double read_ms = 0;     ///< reading the scene and its model files
  double images_ms = 0;   ///< decoding the images of models
  double shadow_ms = 0;   ///< rendering shadow maps
  double prepare_ms = 0;  ///< all other preparation: meshes, other maps, environments
  double draw_ms = 0;     ///< rendering the image
  double render_ms = 0;   ///< images_ms + shadow_ms + prepare_ms + draw_ms
  double write_ms = 0;    ///< encoding and writing the images
  PassStatistics counts;
  bool spheres_without_wireframe = false;
  int pictures = 0, empty_pictures = 0;      ///< an empty picture shows only the background color
  NaiveReport naive;                         ///< report of --naive
  std::vector<ApproximationChoice> choices;  ///< settings chosen by --max-error for the last image
  std::vector<SimplifiedModel> models;       ///< of the last image
};

/// Calls visit(name, milliseconds) for each stage of a run.
template <class F>
void for_each_stage(const RenderReport& r, F&& visit) {
  visit("read_ms", r.read_ms);
  visit("images_ms", r.images_ms);
  visit("prepare_ms", r.prepare_ms);
  visit("shadow_ms", r.shadow_ms);
  visit("draw_ms", r.draw_ms);
  visit("render_ms", r.render_ms);
  visit("write_ms", r.write_ms);
}

/// Formats the report as lines of name and value.
std::string text_report(const RenderReport& report);

/// Formats the report as a JSON object.
std::string json_report(const RenderReport& report);

}  // namespace halfspace
