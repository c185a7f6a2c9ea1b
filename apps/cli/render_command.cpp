// SPDX-License-Identifier: Apache-2.0
//
// `halfspace render SCENE...`: validates all arguments, then renders the pictures of one scene or of a list of scenes.
#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "cli/empty_picture.h"
#include "cli/render_list.h"
#include "cli/render_run.h"
#include "cli/stage_display.h"
#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "halfspace/core/check.h"
#include "halfspace/core/parallel.h"
#include "halfspace/image/atomic_output.h"

namespace halfspace {

namespace {

// Returns the scene with the settings that --max-error chooses.
SceneFile chosen(const RenderJob& job) {
  const RenderOptions& o = job.options;
  SceneFile scene = job.scene;
  if (!o.allowed) return scene;
  const Workers workers(o.threads);
  SceneAssets assets(workers);
  std::vector<std::string> settings;
  for (const ApproximationChoice& c : assets.choose_within_error(scene.at(o.time), o.size.width, o.size.height, *o.allowed).choices) {
    if (c.is_setting) settings.push_back(c.key + "=" + c.value);
  }
  scene.set(settings);
  return scene;
}

// Returns the indices of a shard: index, index + count, ... below total.
NextIndex indices_of(const Shard& shard, int total) {
  return [i = shard.index, shard, total]() mutable -> std::optional<int> {
    if (i >= total) return std::nullopt;
    const int index = i;
    i = total - i > shard.count ? i + shard.count : total;
    return index;
  };
}

ProgressStyle progress_style(const RenderArguments& args) {
  if (args.quiet) return ProgressStyle::none;
  if (args.progress == "json") return ProgressStyle::json;
  return args.verbose ? ProgressStyle::lines : ProgressStyle::bar;
}

// Prints the results of a run. scene, output: names for --stats.
void print_results(const RenderOptions& o, const RenderRun& run, const std::string& scene, const std::filesystem::path& output,
                   double read_ms = 0.0) {
  const RenderArguments& args = o.arguments;
  RenderReport report = run.report();
  if (report.spheres_without_wireframe) print_warning("spheres that are not meshes have no wireframe; they are drawn as surfaces");
  if (args.resume) print_note(run.resumed().line());
  // If the image goes to standard output, print the reports to standard error.
  std::ostream& out = is_standard_output(output) ? std::cerr : std::cout;
  if (args.naive && report.naive.pixels > 0) out << naive_line(report.naive, o.threads);
  if (args.statistics.empty()) return;
  report.scene = scene;
  report.output = output.string();
  const PictureSize size = picture_size(o);
  report.width = size.width;
  report.height = size.height;
  report.threads = o.threads;
  report.read_ms = read_ms;
  out << (args.statistics == "json" ? json_report(report) : text_report(report));
}

void render_scenes(const RenderOptions& options) {
  const auto scenes = static_cast<int>(options.scenes.size());
  Progress progress(progress_style(options.arguments), int64_t{options.shard.share_of(scenes)} * options.pictures_per_scene());
  RenderRun run(options, progress);
  const ListCounts counts = render_list(options, indices_of(options.shard, scenes), run);
  print_results(options, run, fmt::format("{} scenes", counts.scenes), options.out.empty() ? "-" : options.out);
  if (counts.failed > 0) throw InputError(fmt::format("{} of {} scenes failed; the others are complete", counts.failed, counts.scenes));
}

void render_scene(const RenderOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  std::optional<StageDisplay> stage;
  if (!options.arguments.quiet) stage.emplace("reading " + options.scenes[0]);
  const RenderJob job = open_job(options, options.scenes[0]);
  stage.reset();
  if (options.arguments.print) {
    std::cout << chosen(job).print();
    return;
  }
  const double read_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  const int pictures = options.pictures_per_scene();
  Progress progress(progress_style(options.arguments), options.shard.share_of(pictures));
  RenderRun run(options, progress);
  if (!options.frames && !options.arguments.quiet) stage.emplace("rendering " + job.out.string());
  run.render(job, indices_of(options.shard, pictures));
  stage.reset();
  if (const std::string advice = advice_for_empty_pictures(job, run.report()); !advice.empty())
    print_warning("nothing is visible in the picture; try " + advice);
  print_results(options, run, job.name, job.out, read_ms);
}

}  // namespace

void render_command(const RenderArguments& args) {
  set_quiet(args.quiet);
  const RenderOptions options = parse_options(args);
  options.is_list() ? render_scenes(options) : render_scene(options);
}

}  // namespace halfspace
