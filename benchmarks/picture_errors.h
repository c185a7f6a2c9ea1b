// SPDX-License-Identifier: Apache-2.0
//
// How far a workload's picture lies from the same picture in double precision.
#pragma once

#include <filesystem>
#include <string_view>

#include "workload.h"

namespace halfspace {

/// Over the pixels that either picture draws; over all where no depth tells which those are.
struct PictureErrors {
  int covered = 0;
  int colors_off = 0;      ///< with a channel further than 1/255 from the truth
  int depths_off = 0;      ///< further than the tolerance given; 0 where the picture has no depth
  int background_off = 0;  ///< of the other pixels, those that do not hold the nearest code of what was cleared to
  double worst_color = 0;  ///< of all channels, in 1/255
  double rms_color = 0;    ///< the same, root of the mean square
  double worst_depth = 0;
};

PictureErrors picture_errors(const WorkloadPicture& picture, const WorkloadTruth& truth, double depth_tolerance);

/// A workload's truth from directory/NAME.WxH.truth, which is made where it does not exist: a truth takes long. It holds floats.
WorkloadTruth kept_truth(const std::filesystem::path& directory, std::string_view name, const Workload& workload, WorkloadSize size);

}  // namespace halfspace
