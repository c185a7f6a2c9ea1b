// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace {

/// Twice the area of three corners: > 0 where they turn left.
inline int64_t turn(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
  return int64_t{b.x - a.x} * (c.y - a.y) - int64_t{b.y - a.y} * (c.x - a.x);
}

/// How a clipped polygon becomes a fan of triangles.
///
/// Snapping can bend a nearly straight corner inwards; a fan from elsewhere would turn a piece over and draw its samples
/// twice. From `apex` all pieces turn one way. Where the outline of a sliver crosses itself there is no such corner; then
/// pieces that turn against the whole are left out, and their samples remain drawn by the others.
struct Fan {
  uint32_t apex = 0;
  bool turns_left = false;
};

inline Fan fan_of(const ClipVertex* v, uint32_t count) {
  Fan fan;
  for (uint32_t apex = 0; apex < count; ++apex) {
    bool left = false, right = false;
    int64_t area = 0;
    for (uint32_t i = 2; i < count; ++i) {
      const int64_t piece = turn(v[apex].screen, v[(apex + i - 1) % count].screen, v[(apex + i) % count].screen);
      left |= piece > 0;
      right |= piece < 0;
      area += piece;
    }
    fan = {apex, area > 0};
    if (!(left && right)) return fan;
  }
  return fan;
}

}  // namespace halfspace
