// SPDX-License-Identifier: Apache-2.0
//
// `halfspace explain SCENE`: shows what the pipeline did in one frame.
#include "cli/explain_command.h"

#include <fmt/format.h>

#include <iostream>

#include "cli/commands.h"
#include "cli/stage_display.h"
#include "command_line/arguments.h"
#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "command_line/scene_arguments.h"
#include "halfspace/core/check.h"
#include "halfspace/core/text.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/render/model_file/input_files.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

namespace {

// Parses a pixel such as "12,34".
std::optional<glm::ivec2> parse_pixel(const std::string& text, const PictureSize& size) {
  if (text.empty()) return std::nullopt;
  const std::size_t comma = text.find(',');
  const std::string_view all = text;
  const int x = parse_number(all.substr(0, comma)), y = comma == std::string::npos ? -1 : parse_number(all.substr(comma + 1));
  if (x < 0 || y < 0 || x >= size.width || y >= size.height) {
    throw UsageError(
        fmt::format("--pixel is '{}'; expected X,Y from 0,0 at the upper left to {},{}", text, size.width - 1, size.height - 1));
  }
  return glm::ivec2(x, y);
}

OpenedScene open_explained_scene(const ExplainArguments& args, const PictureSize& size, double time) {
  const std::vector<double> times = args.time.empty() ? std::vector<double>{} : std::vector{time};
  OpenedScene opened = open_scene_or_model(args.scene, args.model, args.camera, static_cast<double>(size.width) / size.height, 30.0, times);
  set_scene(opened, args.set, args.camera);
  set_shading(opened.scene, args.shading);
  return opened;
}

PreparedScene prepare_explained(const SceneDescription& scene, const SceneFile& file, const PictureSize& size, SceneAssets& assets) {
  try {
    return assets.prepare(scene, size.width, size.height);
  } catch (const InputError& e) {
    throw InputError(message_in_scene(file, e.what()));
  }
}

// Throws UsageError if a browser would not read the address as that of files.
void check_lessons(const std::string& address) {
  const std::size_t colon = address.find(':');
  const std::string scheme = colon < address.find('/') ? address.substr(0, colon) : "";
  if ((scheme.empty() || scheme == "http" || scheme == "https" || scheme == "file") && printable(address) == address) return;
  throw UsageError("--lessons is '" + address + "'; expected a web address or a path relative to the page, for example ../lessons");
}

}  // namespace

void explain_command(const ExplainArguments& args) {
  set_limits(args.limits);
  const PictureSize size = parse_size(args.size);
  const std::optional<glm::ivec2> pixel = parse_pixel(args.pixel, size);
  if (args.text && args.json) throw UsageError("--text and --json cannot be combined; expected at most one of them");
  const bool is_page = !args.text && !args.json;
  if (!is_page && !args.lessons.empty()) throw UsageError("--lessons applies only to the page; expected it without --text and --json");
  check_lessons(args.lessons);
  if (!is_page && !args.out.empty()) throw UsageError("-o applies only to the page; expected it without --text and --json");
  const double time = args.time.empty() ? 0.0 : parse_real("--time", args.time, -1e9, 1e9, "-1e9 to 1e9 seconds, for example 2.5");
  const Workers workers(parse_threads(args.threads));
  check_picture(size, sizeof(glm::vec4));
  const std::filesystem::path out = is_page ? page_path(args) : std::filesystem::path();
  if (is_page) check_writable(out);
  std::string output;
  {
    const StageDisplay explaining("explaining " + args.scene);
    SceneAssets assets(workers, print_warning);
    const OpenedScene opened = open_explained_scene(args, size, time);
    const ReadModels models = read_models(opened);
    add_models(assets, models);
    const SceneDescription scene = opened.scene.at(time);
    if (is_page) reject_overwriting(out, input_files(scene, args.scene, models));
    const PreparedScene prepared = prepare_explained(scene, opened.scene, size, assets);
    const ExplainJob job{scene, prepared, args.scene, pixel, explain_commands(args, time), args.lessons, workers};
    output = is_page ? page_of(job) : explained_history(job, args.json);
  }
  if (!is_page) {
    std::cout << output;
    return;
  }
  write_file(out, std::as_bytes(std::span(output)));
}

}  // namespace halfspace
