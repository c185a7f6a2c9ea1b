// SPDX-License-Identifier: Apache-2.0
//
// `render --naive`: draws with the naive pipeline (raster/naive.h) and compares the result with the tile-based one.
#pragma once

#include <cstdint>
#include <string>

#include "halfspace/render/frame/frame.h"

namespace halfspace {

/// Totals over all pictures of a run.
struct NaiveReport {
  int64_t pixels = 0, differing = 0;  ///< compared bit by bit as linear light, before exposure and tone curve
  double naive_ms = 0, tiles_ms = 0;  ///< times to draw that light
};

/// Fills the color images with the picture that the naive pipeline draws. Also draws the scene with the tile-based pipeline, and adds the
/// differences and times to the report. naive_obstacle() must have returned an empty string. Returns the statistics of the tile-based
/// pipeline.
PassStatistics draw_naive_picture(const PreparedScene& scene, const FrameImages& images, const Workers& workers, NaiveReport& report);

/// Formats the report as one line. threads: number of threads of the tile-based pipeline.
std::string naive_line(const NaiveReport& report, int threads);

}  // namespace halfspace
