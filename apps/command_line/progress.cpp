// SPDX-License-Identifier: Apache-2.0
#include "command_line/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
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
int terminal_columns() {
  winsize size = {};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
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
  std::fputs(("\r\033[K" + text.substr(0, static_cast<std::size_t>(std::max(terminal_columns() - 1, 0)))).c_str(), stderr);
  std::fflush(stderr);
  line_shown = true;
}

Progress::Progress(ProgressStyle style, int64_t total, std::function<int64_t()> others)
    : style_(style), total_(total), others_(std::move(others)), start_(std::chrono::steady_clock::now()) {
  if (style == ProgressStyle::bar && (total < 2 || ::isatty(STDERR_FILENO) != 1)) style_ = ProgressStyle::none;
  if (style_ == ProgressStyle::bar) show_bar();
}

Progress::~Progress() { clear_progress(); }

void Progress::skip(int64_t pictures) {
  own_ += pictures;
  kept_ += pictures;
}

void Progress::advance(bool kept, const std::string& file, std::chrono::steady_clock::duration spent) {
  ++own_;
  kept_ += kept ? 1 : 0;
  done_ = own_ + (others_ ? others_() : 0);
  if (style_ == ProgressStyle::bar) show_bar();
  const double ms = std::chrono::duration<double, std::milli>(spent).count();
  if (style_ == ProgressStyle::lines)
    std::fputs(fmt::format("{}/{}  {}  {}\n", done_, total_, printable(file), kept ? "kept" : fmt::format("{:.1f} ms", ms)).c_str(),
               stderr);
  if (style_ != ProgressStyle::json) return;
  std::fputs(fmt::format("{{\"done\": {}, \"total\": {}, \"file\": {}, \"kept\": {}, \"ms\": {:.1f}, \"per_second\": {:.3g}, "
                         "\"seconds_left\": {:.1f}}}\n",
                         done_, total_, json_string(file), kept, ms, pictures_per_second(), seconds_left())
                 .c_str(),
             stderr);
}

double Progress::pictures_per_second() const {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return seconds > 0.0 ? static_cast<double>(done_ - kept_) / seconds : 0.0;
}

double Progress::seconds_left() const {
  const double rate = pictures_per_second();
  return rate > 0.0 ? static_cast<double>(total_ - done_) / rate : 0.0;
}

void Progress::show_bar() const {
  std::string text = fmt::format(" {}/{}", done_, total_);
  if (done_ > kept_)
    text += fmt::format("  {:.3g}/s  {} left", pictures_per_second(), time_text(static_cast<int>(std::min(seconds_left() + 0.5, 1e9))));
  // A line that wraps could not be overwritten, so the bar is shortened if necessary.
  constexpr int kWidest = 30;
  const int width = std::min(kWidest, terminal_columns() - 3 - static_cast<int>(text.size()));
  std::string line = "\r\033[K";
  if (width > 0) {
    const auto filled = static_cast<std::size_t>(width * done_ / total_);
    line += '[';
    line.append(filled, '#').append(static_cast<std::size_t>(width) - filled, '.');
    line += ']';
  }
  std::fputs((line + text).c_str(), stderr);
  std::fflush(stderr);
  line_shown = true;
}

}  // namespace halfspace
