// SPDX-License-Identifier: Apache-2.0
//
// halfspace-bench-embree: draws the sphere workloads by ray casting with Embree.
#include "halfspace/core/cpu.h"
#include "halfspace/core/lanes.h"
#include "peers/embree/embree_workload.h"
#include "runner/bench_program.h"

int main(int argc, char** argv) {
  using namespace halfspace;
  return run_bench_program({.name = "halfspace-bench-embree",
                            .what = "Draws the sphere workloads by ray casting with Embree and measures their frame times",
                            .options = {},
                            .start = {},
                            .kinds = [] { return embree_workloads(); },
                            .sweeps = [] { return embree_sweeps(); },
                            .matrix = {},
                            .scenes = {},
                            .model = {},
                            .identity =
                                [] {
                                  return nlohmann::ordered_json{{"program", "embree"}, {"arch", build_arch()}, {"lanes", kLanes}};
                                }},
                           argc, argv);
}
