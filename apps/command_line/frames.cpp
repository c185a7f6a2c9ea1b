// SPDX-License-Identifier: Apache-2.0
#include "command_line/frames.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "command_line/arguments.h"
#include "command_line/errors.h"

namespace halfspace {

namespace {
constexpr int kMaxFrames = 10000000;
}

FrameRange parse_frames(std::string_view text) {
  const std::size_t dots = text.find("..");
  if (dots != std::string_view::npos) {
    const FrameRange range{parse_number(text.substr(0, dots)), parse_number(text.substr(dots + 2))};
    if (range.first >= 0 && range.last >= range.first && range.last < kMaxFrames) return range;
  }
  throw UsageError("--frames is '" + std::string(text) + "'; expected FIRST..LAST with FIRST at most LAST and LAST below " +
                   std::to_string(kMaxFrames) + ", for example 0..47");
}

std::filesystem::path frame_path(const std::filesystem::path& out, int frame, const FrameRange& range) {
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(range.last).size());
  return out.parent_path() / fmt::format("{}_{:0{}}{}", out.stem().string(), frame, digits, out.extension().string());
}

namespace {

// Returns the frame number in a file name such as "moon_0007" or "moon_0007-camera_normal", if the output is "moon".
std::optional<int> frame_in(const std::string& name, const std::string& output) {
  if (!name.starts_with(output + "_")) return std::nullopt;
  const std::string end = name.substr(output.size() + 1);
  const int number = parse_number(end.substr(0, end.find('-')));
  return number < 0 ? std::nullopt : std::optional(number);
}

}  // namespace

// Reads the folder instead of trying each name, because there may be millions of frames.
std::set<int> existing_frames(const std::filesystem::path& out, const FrameRange& range) {
  std::set<int> frames;
  const std::filesystem::path folder = out.has_parent_path() ? out.parent_path() : ".";
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::optional<int> frame = frame_in(entry->path().stem().string(), out.stem().string());
    if (frame && *frame >= range.first && *frame <= range.last) frames.insert(*frame);
  }
  return frames;
}

std::vector<double> frame_times(const FrameRange& range, double start, double fps) {
  constexpr int kMaxTimes = 1000;
  const int count = std::min(range.count(), kMaxTimes);
  std::vector<double> times;
  for (int i = 0; i < count; ++i) {
    const int64_t frame = range.first + int64_t{range.count() - 1} * i / std::max(count - 1, 1);
    times.push_back(start + static_cast<double>(frame) / fps);
  }
  return times;
}

namespace {

// True while a progress line is shown. Read by the signal handler, so it must be lock-free.
std::atomic<bool> line_shown = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// Returns the width of the terminal, or 80 if it is unknown.
int terminal_columns() {
  winsize size = {};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// Formats a duration as "1:05" or "2:00:07".
std::string time_text(int seconds) {
  if (seconds < 3600) return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
  return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

}  // namespace

void clear_progress() noexcept {
  constexpr char kClear[] = {'\r', '\033', '[', 'K'};
  if (line_shown.exchange(false)) (void)!::write(STDERR_FILENO, kClear, sizeof kClear);
}

void show_progress_line(const std::string& text) {
  // A line that wraps could not be overwritten.
  std::fputs(("\r\033[K" + text.substr(0, static_cast<std::size_t>(std::max(terminal_columns() - 1, 0)))).c_str(), stderr);
  std::fflush(stderr);
  line_shown = true;
}

Progress::Progress(int total)
    : on_terminal_(::isatty(STDERR_FILENO) == 1 && total > 1), total_(total), start_(std::chrono::steady_clock::now()) {
  show();
}

Progress::~Progress() { clear_progress(); }

void Progress::advance(bool skipped) {
  ++done_;
  rendered_ += skipped ? 0 : 1;
  show();
}

void Progress::show() const {
  if (!on_terminal_) return;
  std::string text = fmt::format(" {}/{}", done_, total_);
  if (rendered_ > 0) {
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    text += "  " + time_text(static_cast<int>(std::min(spent / rendered_ * (total_ - done_) + 0.5, 1e9))) + " left";
  }
  // A line that wraps could not be overwritten, so the bar is shortened if necessary.
  constexpr int kWidest = 30;
  const int width = std::min(kWidest, terminal_columns() - 3 - static_cast<int>(text.size()));
  std::string line = "\r\033[K";
  if (width > 0) {
    const auto filled = static_cast<std::size_t>(static_cast<int64_t>(width) * done_ / total_);
    line += '[';
    line.append(filled, '#').append(static_cast<std::size_t>(width) - filled, '.');
    line += ']';
  }
  std::fputs((line + text).c_str(), stderr);
  std::fflush(stderr);
  line_shown = true;
}

}  // namespace halfspace
