// SPDX-License-Identifier: Apache-2.0
//
// `halfspace render SCENE...`: validates all arguments, then renders the pictures of one scene or of a list of scenes.
#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/empty_picture.h"
#include "cli/mpi_queue.h"
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

constexpr const char* kNoWireframe = "spheres that are not meshes have no wireframe; they are drawn as surfaces";

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

ProgressStyle progress_style(const RenderArguments& args) {
  if (args.quiet) return ProgressStyle::none;
  if (args.progress == "json") return ProgressStyle::json;
  return args.verbose ? ProgressStyle::lines : ProgressStyle::bar;
}

// Shows the progress of this process or, with MPI, of all ranks; only rank 0 shows a bar. count: scenes or frames of all processes.
Progress make_progress(const RenderOptions& options, int count, const MpiQueue* mpi) {
  const ProgressStyle style = progress_style(options.arguments);
  const int64_t pictures = options.is_list() ? options.pictures_per_scene() : 1;
  if (mpi == nullptr) return Progress(style, options.shard.share_of(count) * pictures);
  const bool is_shown = style != ProgressStyle::bar || mpi->place().rank == 0;
  return Progress(is_shown ? style : ProgressStyle::none, count * pictures, [mpi] { return mpi->others(); });
}

// Returns the scenes or frames of the shard, or what the queue of MPI hands out.
NextIndex next_index(const RenderOptions& options, int count, MpiQueue* mpi, const Progress& progress) {
  if (mpi == nullptr) return indices_of(count, options.shard);
  mpi->begin(count);
  return [mpi, &progress] { return mpi->next(progress.own()); };
}

// Collects the results of all ranks. Returns false on all but rank 0.
bool collect(MpiQueue* mpi, RunResults& results) {
  if (mpi == nullptr) return true;
  mpi->finish(results.text(), [&](const std::string& other) { results.add(other); });
  return mpi->place().rank == 0;
}

void print_statistics(const RenderOptions& o, RenderReport report, const std::string& scene, const std::filesystem::path& output) {
  // If the image goes to standard output, print the reports to standard error.
  std::ostream& out = o.format.to_standard_output || is_standard_output(output) ? std::cerr : std::cout;
  if (o.arguments.naive && report.naive.pixels > 0) out << naive_line(report.naive, o.threads);
  if (o.arguments.statistics.empty()) return;
  report.scene = scene;
  report.output = output.string();
  const PictureSize size = picture_size(o);
  report.width = size.width;
  report.height = size.height;
  report.threads = o.threads;
  out << (o.arguments.statistics == "json" ? json_report(report) : text_report(report));
}

void render_scenes(const RenderOptions& options, MpiQueue* mpi) {
  const int count = static_cast<int>(options.scenes.size());
  Progress progress = make_progress(options, count, mpi);
  RunResults results;
  RenderRun run(options, progress, results.resumed());
  render_list(options, next_index(options, count, mpi, progress), run, results, progress);
  if (run.report().spheres_without_wireframe) print_warning(kNoWireframe);
  if (!collect(mpi, results)) return;
  if (options.arguments.resume) print_note(results.resumed().line());
  print_statistics(options, run.report(), fmt::format("{} scenes", results.scenes()), options.out.empty() ? "-" : options.out);
  if (!options.arguments.report.empty()) {
    const std::string report = results.report();
    write_file(options.arguments.report, std::as_bytes(std::span(report)));
  }
  if (results.failed() > 0) throw InputError(fmt::format("{} of {} scenes failed", results.failed(), results.scenes()));
}

void render_scene(const RenderOptions& options, MpiQueue* mpi) {
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
  const int count = options.pictures_per_scene();
  Progress progress = make_progress(options, count, mpi);
  RunResults results;
  RenderRun run(options, progress, results.resumed());
  if (!options.frames && !options.arguments.quiet) stage.emplace("rendering " + job.out.string());
  JobCounts counts;
  run.render(job, next_index(options, count, mpi, progress), counts);
  stage.reset();
  RenderReport report = run.report();
  report.read_ms = read_ms;
  if (const std::string advice = advice_for_empty_pictures(job, report); !advice.empty())
    print_warning("nothing is visible in the picture; try " + advice);
  if (report.spheres_without_wireframe) print_warning(kNoWireframe);
  if (!collect(mpi, results)) return;
  if (options.arguments.resume) print_note(results.resumed().line());
  print_statistics(options, std::move(report), job.name, job.out);
}

void render(const RenderOptions& options, MpiQueue* mpi) { options.is_list() ? render_scenes(options, mpi) : render_scene(options, mpi); }

RenderOptions mpi_options(const RenderArguments& args, const MpiPlace& place) {
  if (args.list == "-")
    throw UsageError("--mpi cannot be combined with --list -, because only one rank has a standard input; expected a file");
  RenderOptions options = parse_options(args);
  const char* alone = nullptr;
  if (options.format.to_standard_output || !options.format.is_picture()) alone = "one output for all pictures";
  if (!args.shard.empty()) alone = "--shard";
  if (!args.statistics.empty()) alone = "--stats";
  if (args.naive) alone = "--naive";
  if (args.print) alone = "--print";
  if (!options.frames && !options.is_list()) alone = "a single picture";
  if (alone != nullptr)
    throw UsageError(std::string("--mpi cannot be combined with ") + alone + "; expected frames or scenes with a file each");
  if (args.threads.empty()) options.threads = place.threads;
  if (options.threads > place.cpus)
    print_warning(fmt::format("rank {} is bound to {} CPU{}, but has {} threads; expected mpirun --bind-to none, or fewer --threads",
                              place.rank, place.cpus, place.cpus == 1 ? "" : "s", options.threads));
  return options;
}

// Ends the job if a rank cannot go on. If some scenes of a list failed, all ranks have done their work, and rank 0 returns an error.
void render_with_mpi(const RenderArguments& args) {
  MpiQueue queue;
  std::optional<RenderOptions> options;
  try {
    options.emplace(mpi_options(args, queue.place()));
    render(*options, &queue);
  } catch (const std::exception& e) {
    if (queue.is_finished()) throw;
    // Wrong arguments are an error of all ranks; the line of rank 0 is enough.
    if (!options && queue.place().rank != 0) std::this_thread::sleep_for(std::chrono::seconds(2));
    print_problem(message_of(e));
    queue.abort(exit_code_of(e));
  }
}

}  // namespace

void render_command(const RenderArguments& args) {
  set_quiet(args.quiet);
  args.mpi ? render_with_mpi(args) : render(parse_options(args), nullptr);
}

}  // namespace halfspace
