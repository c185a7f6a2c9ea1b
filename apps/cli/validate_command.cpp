// SPDX-License-Identifier: Apache-2.0
//
// `halfspace validate SCENE`: compares the shadows of a scene with ray-cast shadows.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <iostream>

#include "cli/charting.h"
#include "cli/commands.h"
#include "command_line/arguments.h"
#include "command_line/errors.h"
#include "command_line/scene_arguments.h"
#include "halfspace/core/parallel.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "halfspace/reference/shadow_table.h"
#include "halfspace/render/model_file/input_files.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "study/shadow_study.h"

namespace halfspace {

namespace {

constexpr std::array kPictures{"map", "truth", "difference"};

std::filesystem::path picture_path(const ValidateArguments& args, const std::string& light, const char* picture) {
  return std::filesystem::path(args.out) / fmt::format("{}-{}-{}.png", std::filesystem::path(args.scene).stem().string(), light, picture);
}

void write_pictures(const ValidateArguments& args, const ShadowComparison& c) {
  write_png(picture_path(args, c.score.light, kPictures[0]), light_picture(c.map));
  write_png(picture_path(args, c.score.light, kPictures[1]), light_picture(c.truth));
  write_png(picture_path(args, c.score.light, kPictures[2]), difference_picture(c));
}

// Throws OutputError if a picture would overwrite a file that the scene reads.
void protect_inputs(const ValidateArguments& args, const SceneDescription& scene, const ReadModels& models) {
  const std::vector<std::filesystem::path> inputs = input_files(scene, args.scene, models);
  for (const auto& [light, description] : scene.lights) {
    for (const char* picture : kPictures) reject_overwriting(picture_path(args, light, picture), inputs);
  }
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
  const double time = args.time.empty() ? 0.0 : parse_real("--time", args.time, -1e9, 1e9, "-1e9 to 1e9 seconds, for example 2.5");
  const double rays = args.rays.empty() ? 1024.0 : parse_real("--rays", args.rays, 1, 1e6, "1 to 1000000 rays per pixel, for example 1024");
  OpenedScene opened = open_scene_or_model(args.scene, args.model, args.camera, static_cast<double>(size.width) / size.height, 30.0,
                                           args.time.empty() ? std::vector<double>{} : std::vector{time});
  set_scene(opened, args.set, args.camera);
  const ReadModels models = read_models(opened);
  const SceneDescription scene = opened.scene.at(time);
  if (!args.out.empty()) {
    make_directory(args.out);
    protect_inputs(args, scene, models);
  }
  SceneAssets assets(workers);
  add_models(assets, models);
  const Validation validation = validate(std::filesystem::path(args.scene).stem().string(), scene,
                                         {size.width, size.height, static_cast<int>(rays)}, assets, workers);
  if (!args.out.empty())
    for (const ShadowComparison& c : validation.lights) write_pictures(args, c);
  std::cout << (args.json ? json_report(validation) : text_report(validation));
}

}  // namespace halfspace
