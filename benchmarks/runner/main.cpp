// SPDX-License-Identifier: Apache-2.0
//
// halfspace-bench: draws the workloads, measures their frame times, prints a table or JSON, and writes the images.
#include "halfspace/core/cpu.h"
#include "halfspace/core/lanes.h"
#include "matrix/matrix.h"
#include "runner/bench_program.h"
#include "scenes/scene.h"
#include "workloads/model_workload.h"

// The launcher of a portable build calls this function (see cmake/program.cmake).
extern "C" int halfspace_bench_main(int argc, char** argv) {
  using namespace halfspace;
  return run_bench_program({.name = "halfspace-bench",
                            .what = "Draws the benchmark workloads and measures their frame times",
                            .options = {},
                            .start = {},
                            .kinds = [] { return workloads(); },
                            .sweeps = [] { return sweeps(); },
                            .matrix = [] { return matrix_workloads(); },
                            .scenes = [] { return scene_workloads(); },
                            .views = [] { return view_workloads(); },
                            .model = model_workloads,
                            .has_tasks = true,
                            .identity =
                                [] {
                                  return nlohmann::ordered_json{{"program", "halfspace"}, {"arch", build_arch()}, {"lanes", kLanes}};
                                }},
                           argc, argv);
}

int main(int argc, char** argv) { return halfspace_bench_main(argc, argv); }
