// SPDX-License-Identifier: Apache-2.0
//
// `halfspace validate SCENE`: how right the scene's shadows are, held against rays.
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/charting.h"
#include "cli/commands.h"
#include "cli/scene_arguments.h"
#include "halfspace/core/parallel.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "halfspace/reference/shadow_table.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/study/shadow_study.h"

namespace halfspace {

namespace {

struct ValidateArguments {
  std::string scene;
  std::string out;  // empty: no pictures
  std::string size = "960x540";
  std::vector<std::string> set;
  std::string camera, time, threads, rays;
  bool json = false, table = false, full = false;
};

void write_pictures(const std::filesystem::path& folder, const ShadowComparison& c) {
  const std::string name = c.score.scene + "-" + c.score.light;
  write_png(folder / (name + "-map.png"), light_picture(c.map));
  write_png(folder / (name + "-truth.png"), light_picture(c.truth));
  write_png(folder / (name + "-difference.png"), difference_picture(c));
}

// Rows as they come; the chart when all are known.
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
  if (!write_charted(shadow_table_study(rows, size.width, size.height), command, false, workers, folder)) std::cerr << kNoGnuplot;
}

void validate_command(const ValidateArguments& args) {
  const PictureSize size = parse_size(args.size);
  const Workers workers(parse_threads(args.threads));
  if (args.full && !args.table) throw UsageError("--full is for the table; expected --table too");
  if (args.table != args.scene.empty()) {
    throw UsageError(args.table ? "--table has scenes of its own; expected no SCENE"
                                : "SCENE is required, or --table; see 'halfspace validate --help'");
  }
  if (args.table) return print_table(args, size, workers);
  const double time = args.time.empty() ? 0.0 : parse_real("--time", args.time, -1e9, 1e9, "seconds, for example 2.5");
  const double rays = args.rays.empty() ? 1024.0 : parse_real("--rays", args.rays, 1, 1e6, "rays a pixel, for example 1024");
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

}  // namespace

void add_validate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("validate", "Hold a scene's shadows against rays");
  const auto args = std::make_shared<ValidateArguments>();
  command->add_option("SCENE", args->scene, "A scene's name, or a scene file")->type_name("");
  command->add_flag("--json", args->json, "Report as JSON: one object per light");
  command->add_option("-o,--output", args->out, "Write pictures: map, truth, difference; or a chart")->type_name("DIR");
  command->add_flag("--table", args->table, "Every bias and filter on four scenes, as CSV");
  command->add_flag("--full", args->full, "With --table: every combination (hours)");
  add_set_option(command, args->set);
  command->add_option("--size", args->size, "Pixels (default 960x540)")->type_name("WxH");
  command->add_option("--camera", args->camera, "One of the scene's cameras")->type_name("NAME");
  command->add_option("--time", args->time, "Seconds into the animation (default 0)")->type_name("S");
  command->add_option("--rays", args->rays, "Per pixel, for lights with a size (default 1024)")->type_name("N");
  command->add_option("--threads", args->threads, "Threads (default: one a core)")->type_name("N");
  command->footer(
      "Examples:\n"
      "  halfspace validate moon --json\n"
      "  halfspace validate shadow-plane --set shadow.bias=constant -o out");
  command->callback([args] { validate_command(*args); });
}

}  // namespace halfspace
