// SPDX-License-Identifier: Apache-2.0
//
// The range of sample positions within a pixel, and the storage of samples in a tile.
#pragma once

#include "halfspace/raster/pipeline/pipeline_data.h"
#include "halfspace/shading/sample_positions.h"

namespace halfspace::HS_LANES {

static_assert(kPixelCenter.x == kSubPixels / 2);

/// Returns the range of sample positions for 1, 2, 4 or 8 samples.
constexpr SampleSpan sample_span(int samples) {
  SampleSpan span;
  for (int s = 0; s < samples; ++s) {
    const SamplePosition p = sample_position(samples, s);
    for (const int v : {p.x, p.y}) {
      span.low = v < span.low ? v : span.low;
      span.high = v > span.high ? v : span.high;
    }
  }
  return span;
}

/// Multisampled tiles have fewer pixels. All samples of such a tile share the storage of a single-sampled tile: sample s of pixel (x, y) is
/// stored where that tile stores pixel (x + plane.x, y + plane.y). Code for one sample per pixel can therefore process any sample.
struct SamplePlane {
  int x, y;
};
constexpr SamplePlane sample_plane(int samples, int sample, int tile_size) {
  const int columns = samples == 8 ? 4 : samples == 1 ? 1 : 2;
  return {sample % columns * tile_size, sample / columns * tile_size};
}

/// Returns the maximum tile size for which all samples fit into the storage of a tile.
constexpr int largest_tile(int samples) { return samples == 1 ? kMaxTileSize : samples == 8 ? kMaxTileSize / 4 : kMaxTileSize / 2; }

}  // namespace halfspace::HS_LANES
