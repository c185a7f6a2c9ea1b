// SPDX-License-Identifier: Apache-2.0
//
// The progress display on the terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "command_line/picture_counts.h"

namespace halfspace {

/// How the progress of a run is shown on standard error.
enum class ProgressStyle {
  none,
  bar,    ///< the finished pictures of all processes and the remaining time, if there are several pictures and a terminal
  lines,  ///< one line per picture of this process
  json    ///< the same, each line a JSON object
};

/// Shows the progress of a run of several pictures.
class Progress {
 public:
  /// total: the pictures of all processes. others: returns what other processes have done; may be empty. If it is not, the bar is also
  /// shown if standard error is not a terminal, but that of the parent is: mpirun passes on what its ranks write.
  Progress(ProgressStyle style, int64_t total, std::function<PictureCounts()> others = {});
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Must be called for pictures that are neither rendered nor kept.
  void skip(int64_t pictures);
  /// Must be called after each picture. Kept pictures do not affect the estimate of the remaining time.
  /// file, spent: the picture and its time, for lines.
  void advance(bool kept = false, const std::string& file = {}, std::chrono::steady_clock::duration spent = {});

  /// Returns what this process has done.
  const PictureCounts& own() const { return own_; }

 private:
  void show_bar() const;
  double pictures_per_second() const;  // 0: unknown
  double seconds_left() const;         // 0: unknown

  ProgressStyle style_;
  int64_t total_;
  PictureCounts own_, all_;  // of this process; of all processes
  std::function<PictureCounts()> others_;
  int terminal_;  // file descriptor, or −1
  std::chrono::steady_clock::time_point start_;
};

/// Shows a line on the terminal in place of the previous one. Standard error must be a terminal.
void show_progress_line(const std::string& text);

/// Clears the progress line if one is shown. Async-signal-safe.
void clear_progress() noexcept;

}  // namespace halfspace
