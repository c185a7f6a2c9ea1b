// SPDX-License-Identifier: Apache-2.0
#include "command_line/progress.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "halfspace/core/text.h"

namespace halfspace {

namespace {

// True while a progress line is shown. Read by the signal handler, so it must be lock-free.
std::atomic<bool> line_shown = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// Returns the width of the terminal, or 80 if it is unknown.
int terminal_columns(int terminal) {
  winsize size = {};
  return ::ioctl(terminal, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// Returns standard error if it is a terminal. With `or_parent`, if it is a pipe or socket, returns that of the parent if that is a
// terminal. Otherwise, returns −1.
int find_terminal(bool or_parent) {
  if (::isatty(STDERR_FILENO) == 1) return STDERR_FILENO;
  struct stat status = {};
  const bool is_passed_on = ::fstat(STDERR_FILENO, &status) == 0 && (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode));
  if (!or_parent || !is_passed_on) return -1;
  const int fd = ::open(fmt::format("/proc/{}/fd/{}", ::getppid(), STDERR_FILENO).c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0 || ::isatty(fd) == 1) return fd;
  ::close(fd);
  return -1;
}

// Formats a duration as "1:05" or "2:00:07".
std::string time_text(int seconds) {
  if (seconds < 3600) return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
  return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

// Returns the text as a JSON string. Invalid UTF-8 and control characters are escaped by printable().
std::string json_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : printable(text)) result += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return result + "\"";
}

}  // namespace

void clear_progress() noexcept {
  constexpr char kClear[] = {'\r', '\033', '[', 'K'};
  if (line_shown.exchange(false)) (void)!::write(STDERR_FILENO, kClear, sizeof kClear);
}

void show_progress_line(const std::string& text) {
  // A line that wraps could not be overwritten.
  std::fputs(("\r\033[K" + text.substr(0, static_cast<std::size_t>(std::max(terminal_columns(STDERR_FILENO) - 1, 0)))).c_str(), stderr);
  std::fflush(stderr);
  line_shown = true;
}

Progress::Progress(ProgressStyle style, int64_t total, std::function<PictureCounts()> others)
    : style_(style),
      total_(total),
      others_(std::move(others)),
      terminal_(style == ProgressStyle::bar && total > 1 ? find_terminal(others_ != nullptr) : -1),
      start_(std::chrono::steady_clock::now()) {
  if (style == ProgressStyle::bar && terminal_ < 0) style_ = ProgressStyle::none;
  if (style_ == ProgressStyle::bar) show_bar();
}

Progress::~Progress() {
  clear_progress();
  if (terminal_ >= 0 && terminal_ != STDERR_FILENO) ::close(terminal_);
}

void Progress::skip(int64_t pictures) {
  own_.done += pictures;
  own_.kept += pictures;
}

void Progress::advance(bool kept, const std::string& file, std::chrono::steady_clock::duration spent) {
  ++own_.done;
  own_.kept += kept ? 1 : 0;
  const PictureCounts others = others_ ? others_() : PictureCounts{};
  all_ = {own_.done + others.done, own_.kept + others.kept};
  if (style_ == ProgressStyle::bar) show_bar();
  const double ms = std::chrono::duration<double, std::milli>(spent).count();
  if (style_ == ProgressStyle::lines)
    std::fputs(fmt::format("{}/{}  {}  {}\n", all_.done, total_, printable(file), kept ? "kept" : fmt::format("{:.1f} ms", ms)).c_str(),
               stderr);
  if (style_ != ProgressStyle::json) return;
  std::fputs(fmt::format("{{\"done\": {}, \"total\": {}, \"file\": {}, \"kept\": {}, \"ms\": {:.1f}, \"per_second\": {:.3g}, "
                         "\"seconds_left\": {:.1f}}}\n",
                         all_.done, total_, json_string(file), kept, ms, pictures_per_second(), seconds_left())
                 .c_str(),
             stderr);
}

double Progress::pictures_per_second() const {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return seconds > 0.0 ? static_cast<double>(all_.done - all_.kept) / seconds : 0.0;
}

double Progress::seconds_left() const {
  const double rate = pictures_per_second();
  return rate > 0.0 ? static_cast<double>(total_ - all_.done) / rate : 0.0;
}

void Progress::show_bar() const {
  std::string text = fmt::format(" {}/{}", all_.done, total_);
  if (all_.done > all_.kept)
    text += fmt::format("  {:.3g}/s  {} left", pictures_per_second(), time_text(static_cast<int>(std::min(seconds_left() + 0.5, 1e9))));
  // A line that wraps could not be overwritten, so the bar is shortened if necessary.
  constexpr int kWidest = 30;
  const int width = std::min(kWidest, terminal_columns(terminal_) - 3 - static_cast<int>(text.size()));
  std::string line = "\r\033[K";
  if (width > 0) {
    const auto filled = static_cast<std::size_t>(width * all_.done / total_);
    line += '[';
    line.append(filled, '#').append(static_cast<std::size_t>(width) - filled, '.');
    line += ']';
  }
  std::fputs((line + text).c_str(), stderr);
  std::fflush(stderr);
  line_shown = true;
}

}  // namespace halfspace
