// SPDX-License-Identifier: Apache-2.0
//
// halfspace-bench-gl: draws the workloads with a software OpenGL implementation.
#include <map>
#include <optional>

#include "command_line/errors.h"
#include "peers/gl/gl_context.h"
#include "peers/gl/gl_matrix.h"
#include "peers/gl/gl_model.h"
#include "peers/gl/gl_scenes.h"
#include "peers/gl/gl_workload.h"
#include "runner/bench_program.h"

namespace halfspace {

namespace {

int run(int argc, char** argv) {
  std::string driver = "llvmpipe";
  std::optional<GlContext> context;
  const std::map<std::string, GlDriver> drivers{
      {"llvmpipe", GlDriver::llvmpipe}, {"swiftshader", GlDriver::swiftshader}, {"softpipe", GlDriver::softpipe}};
  return run_bench_program({.name = "halfspace-bench-gl",
                            .what = "Draws the benchmark workloads with a software OpenGL implementation and measures their frame times",
                            .options = {{"--driver", "NAME", "llvmpipe (default), swiftshader or softpipe", &driver}},
                            .start =
                                [&](int threads) {
                                  if (!drivers.contains(driver))
                                    throw UsageError("--driver is '" + driver + "'; expected llvmpipe, swiftshader or softpipe");
                                  context.emplace(drivers.at(driver), threads);
                                },
                            .kinds = [] { return gl_workloads(); },
                            .sweeps = [] { return gl_sweeps(); },
                            .matrix = [] { return gl_matrix_workloads(); },
                            .scenes = [] { return gl_scene_workloads(); },
                            .views = [] { return gl_view_workloads(); },
                            .model = gl_model_workloads,
                            .identity =
                                [&] {
                                  return nlohmann::ordered_json{{"program", driver}, {"renderer", context->description()}};
                                }},
                           argc, argv);
}

}  // namespace

}  // namespace halfspace

int main(int argc, char** argv) { return halfspace::run(argc, argv); }
