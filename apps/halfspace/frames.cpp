// SPDX-License-Identifier: Apache-2.0
#include "halfspace/frames.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "halfspace/arguments.h"
#include "halfspace/commands.h"

namespace halfspace {

namespace {
constexpr int kMostFrames = 10000000;
}

FrameRange parse_frames(std::string_view text) {
  const std::size_t dots = text.find("..");
  if (dots != std::string_view::npos) {
    const FrameRange range{parse_number(text.substr(0, dots)), parse_number(text.substr(dots + 2))};
    if (range.first >= 0 && range.last >= range.first && range.last < kMostFrames) return range;
  }
  throw UsageError("--frames is '" + std::string(text) + "'; expected FIRST..LAST, for example 0..47");
}

std::filesystem::path frame_path(const std::filesystem::path& out, int frame, const FrameRange& range) {
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(range.last).size());
  std::string number = std::to_string(frame);
  number.insert(0, digits - std::min(digits, number.size()), '0');
  return out.parent_path() / (out.stem().string() + "_" + number + out.extension().string());
}

Progress::Progress(int total)
    : on_terminal_(::isatty(STDERR_FILENO) == 1 && total > 1), total_(total), start_(std::chrono::steady_clock::now()) {
  show();
}

Progress::~Progress() {
  if (on_terminal_) std::fprintf(stderr, "\r\033[K");
}

void Progress::advance(bool skipped) {
  ++done_;
  rendered_ += skipped ? 0 : 1;
  show();
}

void Progress::show() const {
  if (!on_terminal_) return;
  constexpr int kWidth = 30;
  const int filled = kWidth * done_ / total_;
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') + std::string(static_cast<std::size_t>(kWidth - filled), '.');
  std::fprintf(stderr, "\r\033[K[%s] %d/%d", bar.c_str(), done_, total_);
  if (rendered_ > 0) {
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const auto left = static_cast<int>(spent / rendered_ * (total_ - done_) + 0.5);
    std::fprintf(stderr, "  %d:%02d left", left / 60, left % 60);
  }
  std::fflush(stderr);
}

}  // namespace halfspace
