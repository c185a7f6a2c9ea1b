// SPDX-License-Identifier: Apache-2.0
//
// Where the samples of a pixel lie, and where they are kept in a tile.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace {

inline constexpr int kMaxSamples = 8;

/// A sample's place in its pixel, from the lower left corner, in 1/256 px.
struct SamplePosition {
  int x, y;
};

/// The standard sample positions of 1, 2, 4 and 8 samples (Vulkan 1.3, "Multisampling": in 1/16 px, as Mesa has them too;
/// here y is up).
inline constexpr std::array<SamplePosition, 15> kSamplePositions{{
    {128, 128},  // 1
    {192, 192},
    {64, 64},  // 2
    {96, 32},
    {224, 96},
    {32, 160},
    {160, 224},  // 4
    {144, 80},
    {112, 176},
    {208, 144},
    {80, 48},
    {48, 208},
    {16, 112},
    {176, 240},
    {240, 16},  // 8
}};
/// samples: 1, 2, 4 or 8.
constexpr SamplePosition sample_position(int samples, int sample) {
  return kSamplePositions[static_cast<std::size_t>(samples - 1 + sample)];
}

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

/// A tile of several samples is smaller, and its samples lie side by side in the room of a whole tile: sample s of pixel
/// (x, y) where pixel (x + cell.x, y + cell.y) of a whole tile lies. So all that works on one sample works on any.
struct SamplePlane {
  int x, y;
};
constexpr SamplePlane sample_plane(int samples, int sample, int tile_size) {
  const int columns = samples == 8 ? 4 : samples == 1 ? 1 : 2;
  return {sample % columns * tile_size, sample / columns * tile_size};
}

/// The largest tile in whose room `samples` cells fit.
constexpr int largest_tile(int samples) { return samples == 1 ? kMaxTileSize : samples == 8 ? kMaxTileSize / 4 : kMaxTileSize / 2; }

}  // namespace halfspace
