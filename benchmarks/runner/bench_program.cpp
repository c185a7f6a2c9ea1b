// SPDX-License-Identifier: Apache-2.0
#include "runner/bench_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>

#include "command_line/arguments.h"
#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "command_line/progress.h"
#include "halfspace/core/text.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "runner/runner.h"
#include "runner/scaling.h"
#include "workloads/picture_errors.h"
#include "workloads/workload_assets.h"

namespace halfspace {

namespace {

struct BenchArguments {
  std::vector<std::string> only;  // empty: all workloads
  std::string sweep;              // empty: the table of workloads
  bool matrix = false;            // draw the rows of the matrix instead of the table of workloads
  bool scenes = false;            // draw the composed scenes instead of the table of workloads
  bool views = false;             // draw the views instead of the table of workloads
  std::string model;              // draw this model file instead of the table of workloads
  std::string size = "1920x1080";
  std::string threads;  // empty: one per core
  std::string seconds = "1";
  std::string out;       // empty: write no images
  std::string check;     // empty: do not compare images with the reference
  bool scaling = false;  // predict the times with more threads instead
  bool list = false;
  bool json = false;
};

// Window depths are close to 1, where the spacing of floats is 6e-8.
constexpr double kDepthTolerance = 1e-5;

const WorkloadKind& workload_of(std::span<const WorkloadKind> kinds, const std::string& name) {
  std::vector<std::string_view> names;
  for (const WorkloadKind& kind : kinds) {
    if (kind.name == name) return kind;
    names.emplace_back(kind.name);
  }
  throw UsageError("--only: unknown workload '" + name + "'" + suggestion(name, names));
}

// Returns the selected workloads in the order of the table, without duplicates.
std::vector<const WorkloadKind*> chosen_workloads(std::span<const WorkloadKind> kinds, const std::vector<std::string>& only) {
  std::vector<const WorkloadKind*> chosen;
  for (const std::string& name : only) chosen.push_back(&workload_of(kinds, name));
  if (only.empty()) {
    for (const WorkloadKind& kind : kinds) chosen.push_back(&kind);
  }
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

std::string padded(std::string_view name) { return fmt::format("{:24} ", name); }

void list_workloads(std::span<const WorkloadKind> kinds) {
  for (const WorkloadKind& kind : kinds) {
    std::cout << padded(kind.name) << kind.what << '\n';
  }
}

void write_pictures(const std::filesystem::path& directory, std::string_view name, const WorkloadPicture& picture) {
  write_png(directory / (std::string(name) + ".png"), *picture.color);
  if (picture.depth != nullptr) write_depth_exr(directory / (std::string(name) + ".depth.exr"), *picture.depth);
}

// Formats a time in milliseconds with microsecond resolution.
std::string milliseconds(double ms) { return fmt::format("{:10.3f}", ms); }

nlohmann::ordered_json json_line(nlohmann::ordered_json line, std::string_view name, PictureSize size, int threads, const FrameTimes& t) {
  line["workload"] = name;
  line["size"] = fmt::format("{}x{}", size.width, size.height);
  line["threads"] = threads;
  line["frames"] = t.frames;
  line["ms"] = t.median;
  line["ms_min"] = t.min;
  line["ms_max"] = t.max;
  line["cpu_ms"] = t.cpu;
  return line;
}

nlohmann::ordered_json json_of(const PictureErrors& e) {
  return {{"covered", e.covered},         {"colors_off", e.colors_off}, {"depths_off", e.depths_off}, {"background_off", e.background_off},
          {"worst_color", e.worst_color}, {"rms_color", e.rms_color}};
}

std::string row(std::string_view name, const FrameTimes& t) {
  return fmt::format("{}{}{}{}{}  {}", padded(name), milliseconds(t.median), milliseconds(t.min), milliseconds(t.max), milliseconds(t.cpu),
                     t.frames);
}

std::string text_of(const PictureErrors& e) {
  return fmt::format("  {:.3f}% within 1/255, rms {:.3f}/255", 100.0 - 100.0 * e.colors_off / std::max(e.covered, 1), e.rms_color);
}

nlohmann::ordered_json json_of(const ShadowMapUse& use) {
  return {{"tiles", use.tiles},           {"filled_tiles", use.filled_tiles},
          {"read_tiles", use.read_tiles}, {"read_filled_tiles", use.read_filled_tiles},
          {"texels", use.texels},         {"read_texels", use.read_texels}};
}

template <class T>
double percent(T part, T all) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(std::max(all, T{1}));
}

std::string text_of(const ShadowMapUse& use) {
  return fmt::format("  reads {:.1f}% of the shadow map's tiles, {:.1f}% of those with casters, {:.1f}% of its texels",
                     percent(use.read_tiles, use.tiles), percent(use.read_filled_tiles, use.filled_tiles),
                     percent(use.read_texels, use.texels));
}

nlohmann::ordered_json json_of(const GeometryUse& use) {
  return {{"triangles", use.triangles},
          {"skipped_triangles", use.skipped_triangles},
          {"binned_triangles", use.binned_triangles},
          {"vertices", use.vertices},
          {"shaded_vertices", use.shaded_vertices}};
}

std::string text_of(const GeometryUse& use) {
  return fmt::format("  of {} triangles, skips {:.1f}% as clusters and bins {:.1f}%; shades {:.1f}% of {} vertices", use.triangles,
                     percent(use.skipped_triangles, use.triangles), percent(use.binned_triangles, use.triangles),
                     percent(use.shaded_vertices, use.vertices), use.vertices);
}

std::string text_of(const PictureDifference& d) {
  return fmt::format("  {:.3f}% of pixels away from edges differ from Halfspace by more than 2/255",
                     100.0 * d.off / std::max(d.compared, 1));
}

// Compares the picture with that of Halfspace, if the workload has one to compare with.
std::optional<PictureDifference> difference_from_twin(const Workload& workload, int threads) {
  const std::unique_ptr<Workload> twin = workload.twin();
  if (twin == nullptr) return std::nullopt;
  twin->frame(Workers(threads));
  return picture_difference(*workload.picture().color, *twin->picture().color);
}

// Formats the fields that identify the renderer for the text output. Each value is preceded by ", ".
std::string identity_text(const BenchProgram& program) {
  std::string text;
  const nlohmann::ordered_json identity = program.identity();
  for (const auto& [key, value] : identity.items())
    text += ", " + (value.is_string() ? value.get<std::string>() : key + ": " + value.dump());
  return text;
}

// Returns the resident memory of the process in MiB, or 0 if it is unknown.
double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  statm >> all >> resident;
  return static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

// Prints the results of one workload, and writes its images if requested. frames_mb: how much the memory of the process grew while drawing;
// only known if a single workload was measured.
void report(const BenchProgram& program, const BenchArguments& args, const WorkloadKind& kind, const Workload& workload, PictureSize size,
            int threads, const FrameTimes& times, std::optional<double> frames_mb) {
  std::optional<PictureErrors> errors;
  std::optional<PictureDifference> difference;
  std::optional<ShadowMapUse> map_use;
  std::optional<GeometryUse> geometry_use;
  if (!args.check.empty()) {
    difference = difference_from_twin(workload, threads);
    map_use = workload.shadow_map_use(Workers(threads));
    geometry_use = workload.geometry_use();
  }
  if (!args.check.empty() && workload.has_truth()) {
    const WorkloadTruth truth = kept_truth(args.check, kind.name, workload, {size.width, size.height});
    errors = picture_errors(workload.picture(), truth, kDepthTolerance);
  }
  if (args.json) {
    nlohmann::ordered_json line = json_line(program.identity(), kind.name, size, threads, times);
    if (frames_mb) line["frames_mb"] = *frames_mb;
    if (errors) line["picture"] = json_of(*errors);
    if (difference) line["difference"] = {{"compared", difference->compared}, {"off", difference->off}};
    if (map_use) line["shadow_map"] = json_of(*map_use);
    if (geometry_use) line["geometry"] = json_of(*geometry_use);
    std::cout << line.dump() << '\n' << std::flush;
  } else {
    std::cout << row(kind.name, times) << (errors ? text_of(*errors) : "") << (difference ? text_of(*difference) : "")
              << (map_use ? text_of(*map_use) : "") << (geometry_use ? text_of(*geometry_use) : "") << '\n'
              << std::flush;
  }
  if (!args.out.empty()) write_pictures(args.out, kind.name, workload.picture());
}

template <class Kinds>
std::vector<WorkloadKind> list_of(const Kinds& kinds) {
  return {kinds.begin(), kinds.end()};
}

// Throws UsageError if several tables are chosen. An empty --sweep counts as none.
void refuse_two_tables(const BenchArguments& args) {
  std::string_view first;
  const auto choose = [&](std::string_view option, bool is_chosen) {
    if (!is_chosen) return;
    if (!first.empty()) throw UsageError(fmt::format("{} cannot be combined with {}", first, option));
    first = option;
  };
  choose("--model", !args.model.empty());
  choose("--views", args.views);
  choose("--scenes", args.scenes);
  choose("--matrix", args.matrix);
  choose("--sweep", !args.sweep.empty());
}

std::vector<WorkloadKind> kinds_of(const BenchProgram& program, const BenchArguments& args) {
  refuse_two_tables(args);
  if (args.matrix && !program.matrix) throw UsageError("--matrix: " + program.name + " does not draw the matrix");
  if (args.scenes && !program.scenes) throw UsageError("--scenes: " + program.name + " does not draw the scenes");
  if (args.views && !program.views) throw UsageError("--views: " + program.name + " does not draw the views");
  if (!args.model.empty() && !program.model) throw UsageError("--model: " + program.name + " does not draw model files");
  if (args.matrix) return list_of(program.matrix());
  if (args.scenes) return list_of(program.scenes());
  if (args.views) return list_of(program.views());
  if (!args.model.empty()) return program.model(args.model);
  const std::string& sweep = args.sweep;
  if (sweep.empty()) return list_of(program.kinds());
  std::vector<std::string_view> names;
  for (const Sweep& s : program.sweeps()) {
    if (s.name == sweep) return list_of(s.kinds);
    names.emplace_back(s.name);
  }
  throw UsageError("--sweep: unknown series '" + sweep + "'" + suggestion(sweep, names));
}

// Prepares the workloads together, measures them and prints their results.
void measure(const BenchProgram& program, const BenchArguments& args, std::span<const WorkloadKind* const> kinds, PictureSize size,
             const Workers& workers, double seconds, WorkloadAssets& assets) {
  std::vector<std::unique_ptr<Workload>> prepared;
  for (const WorkloadKind* kind : kinds) prepared.push_back(kind->prepare({size.width, size.height}, assets));
  std::vector<FrameTimes> times;
  const double mb_before = resident_mb();
  {
    Progress progress(ProgressStyle::bar, Runner::steps(prepared.size(), seconds));
    times = Runner(workers).run(prepared, seconds, [&] { progress.advance(); });
  }
  std::optional<double> frames_mb;
  if (kinds.size() == 1) frames_mb = resident_mb() - mb_before;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    report(program, args, *kinds[i], *prepared[i], size, workers.threads(), times[i], frames_mb);
}

// Prints the serial share of each workload and its predicted speed with more threads. Workloads are prepared one at a time, which needs
// less memory.
void print_scaling(const BenchArguments& args, std::span<const WorkloadKind* const> kinds, PictureSize size, double seconds) {
  if (!args.json) std::cout << scaling_title() << '\n';
  WorkloadAssets assets;
  for (const WorkloadKind* kind : kinds) {
    const std::unique_ptr<Workload> workload = kind->prepare({size.width, size.height}, assets);
    const Scaling scaling = scaling_of(*workload, seconds);
    std::cout << (args.json ? scaling_json(kind->name, scaling).dump() : scaling_row(kind->name, scaling)) << '\n' << std::flush;
  }
}

void run_bench(const BenchProgram& program, const BenchArguments& args) {
  const PictureSize size = parse_size(args.size);
  const int threads = parse_threads(args.threads);
  const double seconds = parse_real("--seconds", args.seconds, 0.0, 3600.0, "0 to 3600, for example 2.5");
  const std::vector<WorkloadKind> all = kinds_of(program, args);
  std::vector<const WorkloadKind*> kinds = chosen_workloads(all, args.only);
  if (args.list) return list_workloads(all);
  if (args.scaling && !program.has_tasks) throw UsageError("--scaling: " + program.name + " has no tasks of its own");
  if (args.scaling) return print_scaling(args, kinds, size, seconds);
  if (!args.out.empty()) make_directory(args.out);

  if (program.start) program.start(threads);
  const Workers workers(threads);
  if (!args.json) {
    std::cout << size.width << 'x' << size.height << ", threads: " << threads << identity_text(program)
              << "\nworkload                     ms median       min       max       cpu  frames\n";
  }
  WorkloadAssets assets;
  if (!args.matrix && !args.scenes && !args.views) return measure(program, args, kinds, size, workers, seconds, assets);
  // Prepares one row at a time, because all rows of the matrix together would take gigabytes. Rows that an OpenGL driver does not support
  // are skipped.
  for (const WorkloadKind*& kind : kinds) {
    try {
      measure(program, args, std::span(&kind, 1), size, workers, seconds, assets);
    } catch (const InputError& error) {
      std::cerr << kind->name << ": skipped: " << error.what() << '\n';
    }
  }
}

void parse_and_run(CLI::App& app, const BenchProgram& program, int argc, char** argv) {
  app.name(program.name);
  set_common_options(app);
  BenchArguments args;
  app.add_option("--only", args.only, "Run only these workloads (see --list)")->type_name("NAME,")->allow_extra_args(false)->delimiter(',');
  app.add_option("--sweep", args.sweep, "Run a series: triangle_size, triangle_count, overdraw, varyings")->type_name("NAME");
  app.add_flag("--matrix", args.matrix, "Run one scene with many draw states instead of the workloads");
  app.add_flag("--scenes", args.scenes, "Run three composed scenes, five cameras each, instead of the workloads");
  app.add_flag("--views", args.views, "Run scenes that are mostly hidden, far away or static, not the workloads");
  app.add_option("--model", args.model, "Run a model file with 1 and 4 samples per pixel, not the workloads")->type_name("FILE");
  app.add_option("--size", args.size, "Image size (default: 1920x1080)")->type_name("WxH");
  app.add_option("--threads", args.threads, "Threads, including the main one (default: one per core)")->type_name("N");
  app.add_option("--seconds", args.seconds, "Time per workload; 0: one frame each (default: 1)")->type_name("S");
  app.add_option("--out", args.out, "Write NAME.png and NAME.depth.exr of each workload to DIR")->type_name("DIR");
  app.add_option("--check", args.check, "Compare with references (slow; cached in DIR); count shadow-map reads")->type_name("DIR");
  app.add_flag("--json", args.json, "Print one JSON object per line for each workload");
  app.add_flag("--scaling", args.scaling, "Predict the speed with more threads from the tasks of one thread");
  app.add_flag("--list", args.list, "Print the workloads and exit");
  for (const BenchOption& option : program.options) app.add_option(option.name, *option.value, option.help)->type_name(option.value_name);
  app.footer("Times are in milliseconds per frame; cpu is the CPU time of all threads. Examples:\n  " + program.name +
             " --only fill,tiny_1m --size 512x512 --threads 1\n  " + program.name + " --seconds 0 --out pictures");
  app.parse(argc, argv);
  run_bench(program, args);
}

}  // namespace

int run_bench_program(const BenchProgram& program, int argc, char** argv) {
  CLI::App app(program.what);
  return run_program(app, [&] { parse_and_run(app, program, argc, argv); });
}

}  // namespace halfspace
