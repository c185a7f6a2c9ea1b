// SPDX-License-Identifier: Apache-2.0
//
// Positions of samples within a pixel.
#pragma once

#include <array>
#include <cstddef>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

inline constexpr int kMaxSamples = 8;

/// Position of a sample relative to the lower left corner of its pixel, in 1/256 px.
struct SamplePosition {
  int x, y;
};
inline constexpr SamplePosition kPixelCenter{128, 128};

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

}  // namespace halfspace::HS_LANES
