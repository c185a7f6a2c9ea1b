// SPDX-License-Identifier: Apache-2.0
#include "cli/render_list.h"

#include <chrono>
#include <future>
#include <new>
#include <utility>

#include "command_line/command_line.h"
#include "halfspace/core/check.h"

namespace halfspace {

namespace {

// Calls a function. Returns the problem that ended it, as one line that begins with the name of the scene, or an empty text.
template <class F>
std::string problem_of(const std::string& scene, F&& render) try {
  render();
  return {};
} catch (const std::exception& e) {
  const std::string problem = message_of(e);
  return problem.starts_with(scene + ":") ? problem : scene + ": " + problem;
}

// Returns the scene that another thread has opened. If there was not enough memory next to the previous scene, opens it again without that.
RenderJob opened_job(std::future<RenderJob> opened, const RenderOptions& options, const std::string& scene, RenderRun& run) {
  try {
    return opened.get();
  } catch (const LimitError&) {
  } catch (const std::bad_alloc&) {
  }
  run.forget_assets();
  return open_job(options, scene);
}

}  // namespace

void render_list(const RenderOptions& options, const NextIndex& next, RenderRun& run, RunResults& results, Progress& progress) {
  const auto read = [&](int i) {
    return std::async(std::launch::async, [&options, i] { return open_job(options, options.scenes[static_cast<std::size_t>(i)]); });
  };
  std::optional<int> current = next();
  std::future<RenderJob> reading = current ? read(*current) : std::future<RenderJob>();
  while (current) {
    const auto start = std::chrono::steady_clock::now();
    const std::string& scene = options.scenes[static_cast<std::size_t>(*current)];
    std::optional<RenderJob> job;
    std::string problem = problem_of(scene, [&] { job.emplace(opened_job(std::move(reading), options, scene, run)); });
    current = next();
    if (current) reading = read(*current);  // while this scene is rendered
    JobCounts counts;
    if (job) problem = problem_of(scene, [&] { run.render(*job, indices_of(options.pictures_per_scene()), counts); });
    if (!problem.empty()) {
      print_problem(problem);
      run.forget_assets();
      progress.skip(options.pictures_per_scene() - counts.rendered - counts.kept);
    }
    results.add_scene(scene, counts, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), problem);
  }
}

}  // namespace halfspace
