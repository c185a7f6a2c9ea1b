// SPDX-License-Identifier: Apache-2.0
//
// The command line shared by the benchmark programs: halfspace-bench and its peers accept the same options and print the same output.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "workloads/sweeps.h"
#include "workloads/workload.h"

namespace halfspace {

/// An additional option of one program.
struct BenchOption {
  std::string name, value_name, help;
  std::string* value;
};

/// The parts that differ between the programs.
struct BenchProgram {
  std::string name;
  std::string what;  ///< one-line description
  std::vector<BenchOption> options;
  std::function<void(int threads)> start;  ///< called once, before any workload is prepared; may be empty
  /// The workloads and sweeps that the program can draw.
  std::function<std::span<const WorkloadKind>()> kinds;
  std::function<std::span<const Sweep>()> sweeps;
  std::function<std::span<const WorkloadKind>()> matrix;                    ///< empty if the program does not draw the matrix
  std::function<std::span<const WorkloadKind>()> scenes;                    ///< empty if the program does not draw the scenes
  std::function<std::span<const WorkloadKind>()> views;                     ///< empty if the program does not draw the views
  std::function<std::vector<WorkloadKind>(const std::string& file)> model;  ///< empty if the program does not draw model files
  bool has_tasks = false;  ///< the program runs tasks with Workers, so that --scaling applies
  /// The first fields of each line of --json output, which identify the renderer.
  std::function<nlohmann::ordered_json()> identity;
};

/// Parses the arguments and runs the benchmark. Returns the exit code.
int run_bench_program(const BenchProgram& program, int argc, char** argv);

}  // namespace halfspace
