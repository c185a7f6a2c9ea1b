// SPDX-License-Identifier: Apache-2.0
//
// Sample positions within a pixel, and the storage of samples in a tile.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace::HS_LANES {

inline constexpr int kMaxSamples = 8;

/// Position of a sample relative to the lower left corner of its pixel, in 1/256 px.
struct SamplePosition {
  int x, y;
};
inline constexpr SamplePosition kPixelCenter{kSubPixels / 2, kSubPixels / 2};

/// Standard sample positions for 1, 2, 4 and 8 samples, as in Vulkan 1.3 ("Multisampling", in units of 1/16 px) and Mesa, but with y up.
inline constexpr std::array<SamplePosition, 15> kSamplePositions{{
    {128, 128},  // 1 sample
    {192, 192},  // 2 samples
    {64, 64},
    {96, 32},  // 4 samples
    {224, 96},
    {32, 160},
    {160, 224},
    {144, 80},  // 8 samples
    {112, 176},
    {208, 144},
    {80, 48},
    {48, 208},
    {16, 112},
    {176, 240},
    {240, 16},
}};
/// Returns the position of a sample. samples must be 1, 2, 4 or 8.
constexpr SamplePosition sample_position(int samples, int sample) {
  return kSamplePositions[static_cast<std::size_t>(samples - 1 + sample)];
}

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
