// SPDX-License-Identifier: Apache-2.0
//
// Compares the image of a workload with the same image rendered in double precision.
#pragma once

#include <filesystem>
#include <string_view>

#include "workload.h"

namespace halfspace {

/// Errors over the covered pixels, which are those that either image draws according to its depth. If neither depth image shows any
/// drawn pixel, all pixels count as covered.
struct PictureErrors {
  int covered = 0;         ///< number of covered pixels
  int colors_off = 0;      ///< pixels with a channel that is wrong by more than 1/255
  int depths_off = 0;      ///< pixels whose depth error exceeds the tolerance; 0 if the image has no depth
  int background_off = 0;  ///< pixels that are not covered and do not have the 8-bit code nearest to the clear color
  double worst_color = 0;  ///< largest error of a channel, in 1/255
  double rms_color = 0;    ///< RMS error over all channels, in 1/255
  double worst_depth = 0;  ///< largest depth error
};

PictureErrors picture_errors(const WorkloadPicture& picture, const WorkloadTruth& truth, double depth_tolerance);

/// Returns the reference image of a workload, rendered in double precision. Rendering it is slow, so the result is cached in
/// directory/NAME.WxH.truth, rounded to float.
WorkloadTruth kept_truth(const std::filesystem::path& directory, std::string_view name, const Workload& workload, WorkloadSize size);

}  // namespace halfspace
