// SPDX-License-Identifier: Apache-2.0
//
// `halfspace validate SCENE`: compares the shadows of a scene with ray-cast shadows.
#include <filesystem>
#include <iostream>

#include "cli/arguments.h"
#include "cli/charting.h"
#include "cli/commands.h"
#include "cli/errors.h"
#include "cli/scene_arguments.h"
#include "halfspace/core/parallel.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "halfspace/reference/shadow_table.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/study/shadow_study.h"

namespace halfspace {

namespace {

void write_pictures(const std::filesystem::path& folder, const ShadowComparison& c) {
  const std::string name = c.score.scene + "-" + c.score.light;
  write_png(folder / (name + "-map.png"), light_picture(c.map));
  write_png(folder / (name + "-truth.png"), light_picture(c.truth));
  write_png(folder / (name + "-difference.png"), difference_picture(c));
}

// Prints each row as soon as it is complete, and writes the chart at the end.
void print_table(const ValidateArguments& args, const PictureSize& size, const Workers& workers) {
  const std::filesystem::path folder = args.out;
  if (!args.out.empty()) {
    make_directory(folder);
    check_writable(folder / "shadow_table.svg");
  }
  std::cout << csv_header() << std::flush;
  const std::vector<TableRow> rows =
      shadow_table(args.full, {size.width, size.height, 1}, workers, [](const TableRow& row) { std::cout << csv_line(row) << std::flush; });
  if (args.out.empty()) return;
  const std::string command = std::string("halfspace validate --table") + (args.full ? " --full" : "");
  const Study study = shadow_table_study(rows, size.width, size.height);
  write_data(study, command, false, workers, folder);
  std::cerr << draw_or_explain({study.name}, folder);
}

}  // namespace

void validate_command(const ValidateArguments& args) {
  set_limits(args.limits);
  const PictureSize size = parse_size(args.size);
  check_picture(size, sizeof(glm::vec4));
  const Workers workers(parse_threads(args.threads));
  if (args.full && !args.table) throw UsageError("--full applies only to --table; expected --table as well");
  if (args.table != args.scene.empty()) {
    throw UsageError(args.table ? "--table uses its own scenes; expected no SCENE"
                                : "SCENE or --table is required; see 'halfspace validate --help'");
  }
  if (args.table) return print_table(args, size, workers);
  const double time = args.time.empty() ? 0.0 : parse_real("--time", args.time, -1e9, 1e9, "seconds, for example 2.5");
  const double rays = args.rays.empty() ? 1024.0 : parse_real("--rays", args.rays, 1, 1e6, "rays per pixel, for example 1024");
  const SceneFile scene = open_scene(args.scene, args.set, args.camera);
  const std::filesystem::path folder = args.out;
  if (!args.out.empty()) make_directory(folder);
  SceneAssets assets(workers);
  const Validation validation = validate(std::filesystem::path(args.scene).stem().string(), scene.at(time),
                                         {size.width, size.height, static_cast<int>(rays)}, assets, workers);
  if (!args.out.empty())
    for (const ShadowComparison& c : validation.lights) write_pictures(folder, c);
  std::cout << (args.json ? json_report(validation) : text_report(validation));
}

}  // namespace halfspace
