// SPDX-License-Identifier: Apache-2.0
#include "cli/render_list.h"

#include <chrono>
#include <future>
#include <new>
#include <utility>

#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "halfspace/core/check.h"

namespace halfspace {

namespace {

// Returns the problem that a scene of a list may have, as one line that begins with its name. Other exceptions pass.
template <class F>
std::string problem_of(const std::string& scene, F&& render) {
  std::string problem;
  try {
    render();
    return {};
  } catch (const InputError& e) {
    problem = e.what();
  } catch (const OutputError& e) {
    problem = e.what();
  } catch (const UsageError& e) {
    problem = e.what();
  } catch (const std::bad_alloc&) {
    problem = "not enough memory; expected a smaller --size or a smaller model";
  }
  return problem.starts_with(scene) ? problem : scene + ": " + problem;
}

NextIndex all_pictures(int count) {
  return [i = 0, count]() mutable { return i < count ? std::optional(i++) : std::nullopt; };
}

}  // namespace

void render_list(const RenderOptions& options, const NextIndex& next, RenderRun& run, RunResults& results) {
  const auto read = [&](int i) {
    return std::async(std::launch::async, [&options, i] { return open_job(options, options.scenes[static_cast<std::size_t>(i)]); });
  };
  std::optional<int> current = next();
  std::future<RenderJob> reading = current ? read(*current) : std::future<RenderJob>();
  while (current) {
    const auto start = std::chrono::steady_clock::now();
    const std::string& scene = options.scenes[static_cast<std::size_t>(*current)];
    reading.wait();  // only one scene is read at a time
    std::future<RenderJob> opened = std::move(reading);
    current = next();
    if (current) reading = read(*current);
    JobCounts counts;
    const std::string problem = problem_of(scene, [&] { counts = run.render(opened.get(), all_pictures(options.pictures_per_scene())); });
    if (!problem.empty()) print_problem(problem);
    results.add_scene(scene, counts, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), problem);
  }
}

}  // namespace halfspace
