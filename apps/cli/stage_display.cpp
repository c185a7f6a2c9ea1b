// SPDX-License-Identifier: Apache-2.0
#include "cli/stage_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>

#include "command_line/progress.h"
#include "halfspace/core/text.h"

namespace halfspace {

StageDisplay::StageDisplay(const std::string& text) {
  if (::isatty(STDERR_FILENO) == 1) thread_ = std::thread([this, text = printable(text)] { show_until_ended(text); });
}

StageDisplay::~StageDisplay() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_one();
  thread_.join();
  clear_progress();
}

void StageDisplay::show_until_ended(const std::string& text) {
  using namespace std::chrono_literals;
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  if (changed_.wait_for(lock, 500ms, [&] { return ended_; })) return;
  do {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - start).count();
    show_progress_line(fmt::format("{} ... {} s", text, seconds));
  } while (!changed_.wait_for(lock, 1s, [&] { return ended_; }));
}

}  // namespace halfspace
