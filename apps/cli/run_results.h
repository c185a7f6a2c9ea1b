// SPDX-License-Identifier: Apache-2.0
//
// What became of the pictures of a run: of one process, or of all ranks of MPI.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/resume.h"

namespace halfspace {

/// The pictures of one scene.
struct JobCounts {
  int rendered = 0, kept = 0;
};

class RunResults {
 public:
  /// Adds a scene of a list. problem: why it failed, or empty.
  void add_scene(const std::string& scene, const JobCounts& counts, double seconds, const std::string& problem);
  ResumeCounts& resumed() { return resumed_; }
  const ResumeCounts& resumed() const { return resumed_; }

  int scenes() const { return static_cast<int>(scenes_.size()); }
  int failed() const { return failed_; }
  /// Returns the file of --report.
  std::string report() const;

  /// Return everything as text, and add the text of another process.
  std::string text() const;
  void add(const std::string& text);

 private:
  nlohmann::ordered_json scenes_ = nlohmann::ordered_json::array();
  int failed_ = 0;
  ResumeCounts resumed_;
};

}  // namespace halfspace
