// SPDX-License-Identifier: Apache-2.0
#include "cli/run_results.h"

#include <utility>

namespace halfspace {

namespace {
constexpr auto kReplaceInvalid = nlohmann::json::error_handler_t::replace;
}

void RunResults::add_scene(const std::string& scene, const JobCounts& counts, double seconds, const std::string& problem) {
  nlohmann::ordered_json entry = {{"scene", scene}, {"rendered", counts.rendered}, {"kept", counts.kept}, {"seconds", seconds}};
  if (!problem.empty()) entry["problem"] = problem;
  scenes_.push_back(std::move(entry));
  failed_ += problem.empty() ? 0 : 1;
}

std::string RunResults::report() const {
  const nlohmann::ordered_json report = {{"scenes", scenes_}, {"failed", failed_}};
  return report.dump(2, ' ', false, kReplaceInvalid) + "\n";
}

std::string RunResults::text() const {
  return nlohmann::ordered_json{{"scenes", scenes_}, {"failed", failed_}, {"resumed", resumed_.counts()}}.dump(-1, ' ', false,
                                                                                                               kReplaceInvalid);
}

void RunResults::add(const std::string& text) {
  const nlohmann::ordered_json other = nlohmann::ordered_json::parse(text);
  for (const nlohmann::ordered_json& scene : other.at("scenes")) scenes_.push_back(scene);
  failed_ += other.at("failed").get<int>();
  resumed_.add(other.at("resumed").get<ResumeCounts::Counts>());
}

}  // namespace halfspace
