// SPDX-License-Identifier: Apache-2.0
//
// halfspace-bench: draws the workloads, measures their frames, prints a table or JSON, writes their pictures.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "halfspace/arguments.h"
#include "halfspace/command_line.h"
#include "halfspace/frames.h"
#include "runner.h"
#include "scene/image_io.h"
#include "scene/nearest_name.h"
#include "scene/output_file.h"
#include "workload_assets.h"

namespace halfspace {

namespace {

struct BenchArguments {
  std::vector<std::string> only;  // empty: all
  std::string size = "1920x1080";
  std::string threads;  // empty: one a core
  std::string seconds = "1";
  std::string out;  // empty: no pictures
  bool list = false;
  bool json = false;
};

const WorkloadKind& workload_of(const std::string& name) {
  std::vector<std::string_view> names;
  for (const WorkloadKind& kind : workloads()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  throw UsageError("--only: unknown workload '" + name + "'" + suggestion(name, names));
}

// In the table's order, each once.
std::vector<const WorkloadKind*> chosen_workloads(const std::vector<std::string>& only) {
  std::vector<const WorkloadKind*> chosen;
  for (const std::string& name : only) chosen.push_back(&workload_of(name));
  if (only.empty()) {
    for (const WorkloadKind& kind : workloads()) chosen.push_back(&kind);
  }
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

void list_workloads() {
  for (const WorkloadKind& kind : workloads()) {
    std::cout << kind.name << std::string(21 - kind.name.size(), ' ') << kind.what << '\n';
  }
}

void write_pictures(const std::filesystem::path& directory, std::string_view name, const WorkloadPicture& picture) {
  write_png(directory / (std::string(name) + ".png"), *picture.color);
  if (picture.depth != nullptr) write_depth_exr(directory / (std::string(name) + ".depth.exr"), *picture.depth);
}

// Three decimals: microseconds.
std::string milliseconds(double ms) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%10.3f", ms);
  return text.data();
}

void print_json(std::string_view name, PictureSize size, int threads, const FrameTimes& t) {
  nlohmann::ordered_json line;
  line["workload"] = name;
  line["size"] = std::to_string(size.width) + "x" + std::to_string(size.height);
  line["threads"] = threads;
  line["arch"] = HALFSPACE_ARCH;
  line["lanes"] = kLanes;
  line["frames"] = t.frames;
  line["ms"] = t.median;
  line["ms_min"] = t.min;
  line["ms_max"] = t.max;
  line["cpu_ms"] = t.cpu;
  std::cout << line.dump() << '\n';
}

void print_row(std::string_view name, const FrameTimes& t) {
  std::cout << name << std::string(21 - name.size(), ' ') << milliseconds(t.median) << milliseconds(t.min) << milliseconds(t.max)
            << milliseconds(t.cpu) << "  " << t.frames << '\n';
}

void run_bench(const BenchArguments& args) {
  const PictureSize size = parse_size(args.size);
  const int threads = parse_threads(args.threads);
  const double seconds = parse_real("--seconds", args.seconds, 0.0, 3600.0, "0 to 3600, for example 2.5");
  const std::vector<const WorkloadKind*> kinds = chosen_workloads(args.only);
  if (args.list) return list_workloads();
  if (!args.out.empty()) make_directory(args.out);

  WorkloadAssets assets;
  std::vector<std::unique_ptr<Workload>> prepared;
  for (const WorkloadKind* kind : kinds) prepared.push_back(kind->prepare({size.width, size.height}, assets));
  const Workers workers(threads);
  std::vector<FrameTimes> times;
  {
    Progress progress(Runner::steps(prepared.size(), seconds));
    times = Runner(workers).run(prepared, seconds, [&] { progress.advance(false); });
  }
  if (!args.json) {
    std::cout << size.width << 'x' << size.height << ", threads: " << threads << ", " HALFSPACE_ARCH ", lanes: " << kLanes
              << "\nworkload                 ms median       min       max       cpu  frames\n";
  }
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (args.json) {
      print_json(kinds[i]->name, size, threads, times[i]);
    } else {
      print_row(kinds[i]->name, times[i]);
    }
    if (!args.out.empty()) write_pictures(args.out, kinds[i]->name, prepared[i]->picture());
  }
}

void parse_and_run(CLI::App& program, int argc, char** argv) {
  program.name("halfspace-bench");
  set_common_options(program);
  BenchArguments args;
  program.add_option("--only", args.only, "These workloads alone (--list names them all)")->type_name("NAME,...")->delimiter(',');
  program.add_option("--size", args.size, "Size of the pictures (default: 1920x1080)")->type_name("WxH");
  program.add_option("--threads", args.threads, "Threads, the main one counted (default: one a core)")->type_name("N");
  program.add_option("--seconds", args.seconds, "Time for each workload; 0: one frame of each (default: 1)")->type_name("S");
  program.add_option("--out", args.out, "Write NAME.png and NAME.depth.exr of each workload into DIR")->type_name("DIR");
  program.add_flag("--json", args.json, "Print a JSON object a line, one for each workload");
  program.add_flag("--list", args.list, "Print the workloads and exit");
  program.footer(
      "Times are milliseconds a frame; cpu is that of all threads together.\n"
      "Examples:\n"
      "  halfspace-bench --only fill,tiny_1m --size 512x512 --threads 1\n"
      "  halfspace-bench --seconds 0 --out pictures");
  program.parse(argc, argv);
  run_bench(args);
}

}  // namespace

}  // namespace halfspace

int main(int argc, char** argv) {
  CLI::App program("Draws the workloads of the benchmark and measures their frames");
  return halfspace::run_program(program, [&] { halfspace::parse_and_run(program, argc, argv); });
}
