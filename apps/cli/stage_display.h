// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace halfspace {

/// Shows what the program is doing and for how long, if it takes more than half a second and standard error is a terminal. The line is
/// removed at the end.
class StageDisplay {
 public:
  explicit StageDisplay(const std::string& text);
  ~StageDisplay();
  StageDisplay(const StageDisplay&) = delete;
  StageDisplay& operator=(const StageDisplay&) = delete;

 private:
  void show_until_ended(const std::string& text);

  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace halfspace
