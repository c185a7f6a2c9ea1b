// SPDX-License-Identifier: Apache-2.0
//
// The progress display on the terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace halfspace {

/// How the progress of a run is shown on standard error.
enum class ProgressStyle {
  none,
  bar,    ///< the finished pictures and the remaining time, if there are several pictures and standard error is a terminal
  lines,  ///< one line per picture
  json    ///< the same, each line a JSON object
};

/// Shows the progress of a run of several pictures.
class Progress {
 public:
  /// others: returns how many pictures other processes have finished; may be empty.
  Progress(ProgressStyle style, int64_t total, std::function<int64_t()> others = {});
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Must be called for pictures that are neither rendered nor kept.
  void skip(int64_t pictures);
  /// Must be called after each picture. Kept pictures do not affect the estimate of the remaining time.
  /// file, spent: the picture and its time, for lines.
  void advance(bool kept = false, const std::string& file = {}, std::chrono::steady_clock::duration spent = {});

 private:
  void show_bar() const;
  double pictures_per_second() const;  // 0: unknown
  double seconds_left() const;         // 0: unknown

  ProgressStyle style_;
  int64_t total_;
  int64_t own_ = 0, kept_ = 0, done_ = 0;  // of this process; own pictures that were kept; of all processes
  std::function<int64_t()> others_;
  std::chrono::steady_clock::time_point start_;
};

/// Shows a line on the terminal in place of the previous one. Standard error must be a terminal.
void show_progress_line(const std::string& text);

/// Clears the progress line if one is shown. Async-signal-safe.
void clear_progress() noexcept;

}  // namespace halfspace
