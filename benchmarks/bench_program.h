// SPDX-License-Identifier: Apache-2.0
//
// The command line that all programs of the benchmark share: halfspace-bench and its peers take the same options and print the
// same lines.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "sweeps.h"
#include "workload.h"

namespace halfspace {

/// An option with a value that one program has of its own.
struct BenchOption {
  std::string name, value_name, help;
  std::string* value;
};

/// What one program has of its own.
struct BenchProgram {
  std::string name;
  std::string what;  ///< one line
  std::vector<BenchOption> options;
  std::function<void(int threads)> start;  ///< called once, before anything is prepared; may be empty
  /// Which workloads it draws, and which series of them.
  std::function<std::span<const WorkloadKind>()> kinds;
  std::function<std::span<const Sweep>()> sweeps;
  /// What the lines of --json begin with: who drew.
  std::function<nlohmann::ordered_json()> identity;
};

/// Parses the arguments and runs; returns the exit code.
int run_bench_program(const BenchProgram& program, int argc, char** argv);

}  // namespace halfspace
