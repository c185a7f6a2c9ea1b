// SPDX-License-Identifier: Apache-2.0
//
// Compares the image of a workload with the same image rendered in double precision.
#pragma once

#include <filesystem>
#include <string_view>

#include "workloads/workload.h"

namespace halfspace {

/// Errors over the covered pixels: those where either depth image shows that something was drawn. If neither image has such a pixel, all
/// pixels count as covered.
struct PictureErrors {
  int covered = 0;         ///< number of covered pixels
  int colors_off = 0;      ///< pixels with a channel that is wrong by more than 1/255
  int depths_off = 0;      ///< pixels whose depth error exceeds the tolerance; 0 if the image has no depth
  int background_off = 0;  ///< uncovered pixels whose value is not the clear color rounded to 8 bits
  double worst_color = 0;  ///< largest error of a channel, in 1/255
  double rms_color = 0;    ///< RMS error over all channels, in 1/255
  double worst_depth = 0;  ///< largest depth error
};

PictureErrors picture_errors(const WorkloadPicture& picture, const WorkloadTruth& truth, double depth_tolerance);

/// Differences between the images of two renderers. Pixels next to an edge in either image are ignored: pixels with a channel that varies
/// by more than 16/255 in their 3 x 3 neighborhood, and the border of the image.
struct PictureDifference {
  int compared = 0;  ///< number of pixels away from edges
  int off = 0;       ///< of these, pixels with a channel that differs by more than 2/255
};

PictureDifference picture_difference(const Image<glm::u8vec4>& a, const Image<glm::u8vec4>& b);

/// Returns the reference image of a workload, rendered in double precision. Rendering it is slow, so the result is cached in
/// directory/NAME.WxH.truth, rounded to float.
WorkloadTruth kept_truth(const std::filesystem::path& directory, std::string_view name, const Workload& workload, WorkloadSize size);

}  // namespace halfspace
