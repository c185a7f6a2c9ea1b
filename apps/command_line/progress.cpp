// SPDX-License-Identifier: Apache-2.0
#include "command_line/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>

namespace halfspace {

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
