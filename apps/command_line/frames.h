// SPDX-License-Identifier: Apache-2.0
//
// Which frames are rendered, and at which times.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace halfspace {

/// The frames first, first + step, ... that are at most last.
struct FrameRange {
  int first = 0, last = 0, step = 1;
  int count() const { return (last - first) / step + 1; }
  int at(int i) const { return first + i * step; }
  bool contains(int frame) const { return frame >= first && frame <= last && (frame - first) % step == 0; }
};

/// Parses "7", "3..17" or "0..100:10". Throws UsageError.
FrameRange parse_frames(std::string_view text);

/// One of several processes that share the frames or the scenes of a run: number i of them belongs to shard i mod count.
struct Shard {
  int index = 0, count = 1;
  bool contains(int i) const { return i % count == index; }
  /// Returns how many of `total` pieces belong to the shard.
  int share_of(int total) const { return static_cast<int>((int64_t{total} - index + count - 1) / count); }
};

/// Parses a shard such as "0/4", the first of four. Throws UsageError.
Shard parse_shard(std::string_view text);

/// Returns the time of each frame in seconds, where frame 0 is at `start`. If there are more than 1000 frames, returns 1000 evenly spaced
/// ones, including the first and the last.
std::vector<double> frame_times(const FrameRange& range, double start, double fps);

}  // namespace halfspace
