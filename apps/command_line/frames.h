// SPDX-License-Identifier: Apache-2.0
//
// Rendering of multiple frames: the range, the output files, and the progress display.
#pragma once

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace halfspace {

/// Frames first … last, inclusive.
struct FrameRange {
  int first = 0, last = 0;
  int count() const { return last - first + 1; }
};

/// Parses a range such as "3..17". Throws UsageError.
FrameRange parse_frames(std::string_view text);

/// Returns the file name of a frame: "moon_0007.png" for "moon.png" and frame 7. Uses more than four digits if the range needs them.
std::filesystem::path frame_path(const std::filesystem::path& out, int frame, const FrameRange& range);

/// Returns the numbers of the frames in the range of which at least one file exists: moon_0007.png or, for example, moon_0007-depth.exr.
std::set<int> existing_frames(const std::filesystem::path& out, const FrameRange& range);

/// Returns the time of each frame in seconds, where frame 0 is at `start`. If there are more than 1000 frames, returns 1000 evenly spaced
/// ones, including the first and the last.
std::vector<double> frame_times(const FrameRange& range, double start, double fps);

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
