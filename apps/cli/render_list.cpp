// SPDX-License-Identifier: Apache-2.0
#include "cli/render_list.h"

#include <chrono>
#include <future>
#include <new>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"

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

// The scenes that one process renders, and what became of them.
class ListReport {
 public:
  void add(const std::string& scene, const JobCounts& counts, double seconds, const std::string& problem) {
    nlohmann::ordered_json entry = {{"scene", scene}, {"rendered", counts.rendered}, {"kept", counts.kept}, {"seconds", seconds}};
    if (!problem.empty()) entry["problem"] = problem;
    scenes_.push_back(std::move(entry));
    ++counts_.scenes;
    counts_.failed += problem.empty() ? 0 : 1;
  }
  const ListCounts& counts() const { return counts_; }
  std::string json() const {
    const nlohmann::ordered_json report = {{"scenes", scenes_}, {"failed", counts_.failed}};
    return report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  }

 private:
  nlohmann::ordered_json scenes_ = nlohmann::ordered_json::array();
  ListCounts counts_;
};

NextIndex all_pictures(int count) {
  return [i = 0, count]() mutable { return i < count ? std::optional(i++) : std::nullopt; };
}

}  // namespace

ListCounts render_list(const RenderOptions& options, const NextIndex& next, RenderRun& run) {
  const auto read = [&](int i) {
    return std::async(std::launch::async, [&options, i] { return open_job(options, options.scenes[static_cast<std::size_t>(i)]); });
  };
  ListReport report;
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
    report.add(scene, counts, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), problem);
  }
  if (!options.arguments.report.empty()) {
    const std::string json = report.json();
    write_file(options.arguments.report, std::as_bytes(std::span(json)));
  }
  return report.counts();
}

}  // namespace halfspace
