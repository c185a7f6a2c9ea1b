// SPDX-License-Identifier: Apache-2.0
#include "command_line/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "command_line/arguments.h"
#include "command_line/errors.h"

namespace halfspace {

namespace {
constexpr int kMaxFrames = 10000000;
constexpr int kMaxShards = 1000000;
}  // namespace

FrameRange parse_frames(std::string_view text) {
  const std::size_t dots = text.find("..");
  const std::size_t colon = dots == std::string_view::npos ? dots : text.find(':', dots);
  FrameRange range;
  range.first = range.last = parse_number(text.substr(0, dots));
  if (dots != std::string_view::npos)
    range.last = parse_number(text.substr(dots + 2, colon == std::string_view::npos ? colon : colon - dots - 2));
  if (colon != std::string_view::npos) range.step = parse_number(text.substr(colon + 1));
  if (range.first < 0 || range.last < range.first || range.last >= kMaxFrames || range.step < 1) {
    throw UsageError(
        fmt::format("--frames is '{}'; expected FIRST..LAST or FIRST..LAST:STEP with FIRST at most LAST, LAST below {} and STEP at "
                    "least 1, for example 0..47, or the number of one frame",
                    text, kMaxFrames));
  }
  return range;
}

Shard parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string_view::npos) {
    const Shard shard{parse_number(text.substr(0, slash)), parse_number(text.substr(slash + 1))};
    if (shard.index >= 0 && shard.index < shard.count && shard.count <= kMaxShards) return shard;
  }
  throw UsageError(fmt::format("--shard is '{}'; expected I/N with I from 0 to N - 1 and N up to {}, for example 0/4", text, kMaxShards));
}

std::vector<double> frame_times(const FrameRange& range, double start, double fps) {
  constexpr int kMaxTimes = 1000;
  const int count = std::min(range.count(), kMaxTimes);
  std::vector<double> times;
  for (int i = 0; i < count; ++i) {
    const int frame = range.at(static_cast<int>(int64_t{range.count() - 1} * i / std::max(count - 1, 1)));
    times.push_back(start + static_cast<double>(frame) / fps);
  }
  return times;
}

}  // namespace halfspace
