// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/texel_overlap.h"

#include <cstdint>
#include <cstdlib>
#include <utility>

namespace halfspace::HS_LANES {

namespace {

// The bytes of a layer: rows of `width` bytes, the first one at address `first`.
struct Rows {
  std::intptr_t first, width, count, pitch;
  std::intptr_t end() const { return first + (count - 1) * pitch + width; }
};

Rows rows_of(const ConstTexelView& view, int layer) {
  const std::byte* const lowest = view.at(0, view.row_pitch < 0 ? view.height - 1 : 0, layer);
  // With a pitch of 0, all rows are the same.
  return {reinterpret_cast<std::intptr_t>(lowest), std::intptr_t{view.width} * texel_info(view.format).bytes,
          view.row_pitch == 0 ? 1 : view.height, std::abs(view.row_pitch)};
}

bool overlap(Rows a, Rows b) {
  if (b.first < a.first) std::swap(a, b);
  if (b.first >= a.end()) return false;
  if (a.count == 1 || (b.count > 1 && a.pitch != b.pitch)) return true;
  // The first row of b begins in, or after, row `row` of a. Its end can be in the next row.
  const std::intptr_t row = (b.first - a.first) / a.pitch, column = (b.first - a.first) % a.pitch;
  return column < a.width || (column + b.width > a.pitch && row + 1 < a.count);
}

}  // namespace

bool overlap(const ConstTexelView& a, const ConstTexelView& b) {
  for (int i = 0; i < a.layers; ++i) {
    for (int k = 0; k < b.layers; ++k) {
      if (overlap(rows_of(a, i), rows_of(b, k))) return true;
    }
  }
  return false;
}

bool has_overlapping_layers(const ConstTexelView& view) {
  for (int i = 0; i < view.layers; ++i) {
    for (int k = i + 1; k < view.layers; ++k) {
      if (overlap(rows_of(view, i), rows_of(view, k))) return true;
    }
  }
  return false;
}

}  // namespace halfspace::HS_LANES
