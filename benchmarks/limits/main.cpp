// SPDX-License-Identifier: Apache-2.0
//
// halfspace-limits: measures the peak rates of this machine.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "command_line/arguments.h"
#include "command_line/command_line.h"
#include "halfspace/core/cpu.h"
#include "halfspace/core/lanes.h"
#include "limits/limits.h"

namespace halfspace {

namespace {

void print(const Limit& limit, int threads, bool json) {
  if (json) {
    const nlohmann::ordered_json line{{"limit", limit.name}, {"unit", limit.unit},   {"value", limit.value},
                                      {"threads", threads},  {"arch", build_arch()}, {"lanes", kLanes}};
    std::cout << line.dump() << '\n';
    return;
  }
  std::cout << fmt::format("{:26}{:10.2f}  {}\n", limit.name, limit.value, limit.unit);
}

void parse_and_run(CLI::App& program, int argc, char** argv) {
  program.name("halfspace-limits");
  set_common_options(program);
  std::string threads_text, seconds_text = "0.03";
  bool json = false;
  program.add_option("--threads", threads_text, "Threads, including the main one (default: one per core)")->type_name("N");
  program.add_option("--seconds", seconds_text, "Duration of a trial (default: 0.03)")->type_name("S");
  program.add_flag("--json", json, "Print each limit as a JSON object on its own line");
  program.footer(
      "Each value is the best of 15 trials and the total of all threads.\n"
      "Examples:\n"
      "  halfspace-limits --threads 1\n"
      "  halfspace-limits --seconds 1 --json");
  program.parse(argc, argv);

  const LimitTimer timer(parse_threads(threads_text), parse_real("--seconds", seconds_text, 0.001, 60.0, "0.001 to 60, for example 0.1"));
  if (!json) std::cout << "threads: " << timer.threads() << ", " << build_arch() << ", lanes: " << kLanes << '\n';
  for (const auto measure : {compute_limits, bandwidth_limits, frame_limits}) {
    for (const Limit& limit : measure(timer)) print(limit, timer.threads(), json);
  }
}

}  // namespace

}  // namespace halfspace

int main(int argc, char** argv) {
  CLI::App program("Measures the memory bandwidth, arithmetic and gather rates, and clock of this machine");
  return halfspace::run_program(program, [&] { halfspace::parse_and_run(program, argc, argv); });
}
