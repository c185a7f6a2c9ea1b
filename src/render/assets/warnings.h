// SPDX-License-Identifier: Apache-2.0
//
// Reports problems that do not prevent rendering.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Passes warnings of one line to a function, or ignores them if there is none. Not thread-safe.
class Warnings {
 public:
  explicit Warnings(std::function<void(const std::string&)> report) : report_(std::move(report)) {}

  void warn(const std::string& problem) const {
    if (report_) report_(problem);
  }
  /// Ignores problems that this function has already reported.
  void warn_once(const std::string& problem) {
    if (reported_.insert(problem).second) warn(problem);
  }

 private:
  std::function<void(const std::string&)> report_;
  std::set<std::string> reported_;
};

}  // namespace halfspace::HS_LANES
