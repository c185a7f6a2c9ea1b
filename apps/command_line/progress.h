// SPDX-License-Identifier: Apache-2.0
//
// The progress display on the terminal.
#pragma once

#include <chrono>
#include <string>

namespace halfspace {

/// Shows the number of finished frames and the estimated remaining time on standard error. Prints nothing if standard error is not a
/// terminal, or if there is only one frame.
class Progress {
 public:
  explicit Progress(int total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Must be called after each frame. Skipped frames do not affect the estimate of the remaining time.
  void advance(bool skipped);

 private:
  void show() const;

  bool on_terminal_;
  int total_, done_ = 0, rendered_ = 0;
  std::chrono::steady_clock::time_point start_;
};

/// Shows a line on the terminal in place of the previous one. Standard error must be a terminal.
void show_progress_line(const std::string& text);

/// Clears the progress line if one is shown. Async-signal-safe.
void clear_progress() noexcept;

}  // namespace halfspace
