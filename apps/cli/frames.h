// SPDX-License-Identifier: Apache-2.0
//
// Several frames: which, at what times, into which files; and how far the work is.
#pragma once

#include <chrono>
#include <filesystem>
#include <string_view>

namespace halfspace {

/// Frames first … last, both included.
struct FrameRange {
  int first = 0, last = 0;
  int count() const { return last - first + 1; }
};

/// "3..17". Throws UsageError.
FrameRange parse_frames(std::string_view text);

/// The file of one frame: "moon.png" and frame 7 make "moon_0007.png"; more than four digits where the range needs them.
std::filesystem::path frame_path(const std::filesystem::path& out, int frame, const FrameRange& range);

/// A line on standard error that tells how many frames are done and how long the rest will take; nothing where standard
/// error is no terminal.
class Progress {
 public:
  explicit Progress(int total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more is done; `skipped` ones took no time and say nothing of the rest.
  void advance(bool skipped);

 private:
  void show() const;

  bool on_terminal_;
  int total_, done_ = 0, rendered_ = 0;
  std::chrono::steady_clock::time_point start_;
};

/// Clears the line of the Progress that is shown, if one is. For signal handlers: async-signal-safe.
void clear_progress() noexcept;

}  // namespace halfspace
