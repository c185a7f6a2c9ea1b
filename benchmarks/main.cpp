// SPDX-License-Identifier: Apache-2.0
//
// halfspace-bench: draws the workloads, measures their frames, prints a table or JSON, writes their pictures.
#include "bench_program.h"
#include "halfspace/core/cpu.h"
#include "halfspace/core/lanes.h"

int main(int argc, char** argv) {
  using namespace halfspace;
  return run_bench_program({.name = "halfspace-bench",
                            .what = "Draws the workloads of the benchmark and measures their frames",
                            .options = {},
                            .start = {},
                            .kinds = [] { return workloads(); },
                            .sweeps = [] { return sweeps(); },
                            .identity =
                                [] {
                                  return nlohmann::ordered_json{{"program", "halfspace"}, {"arch", build_arch()}, {"lanes", kLanes}};
                                }},
                           argc, argv);
}
