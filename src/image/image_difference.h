// SPDX-License-Identifier: Apache-2.0
//
// Measures the difference between two images, as numbers and as an image.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"

namespace halfspace::HS_LANES {

/// Differences over red, green and blue, and over alpha unless both images are fully opaque. 8-bit values are divided by 255.
struct ImageDifference {
  int channels = 3;
  int64_t differing = 0;     ///< pixels with a channel that differs at all
  double rmse = 0.0;         ///< root of the mean squared difference, over all channels
  double mean = 0.0;         ///< mean absolute difference
  double psnr_db = 0.0;      ///< 20·log10(1/rmse); infinite for identical images
  double max = 0.0;          ///< maximum over all channels
  double p999 = 0.0;         ///< 99.9th percentile over pixels of the maximum difference over channels
  double share_above = 0.0;  ///< fraction of pixels with a channel that differs by more than 1/255
  double ssim = 1.0;         ///< mean structural similarity; 1 for identical images
};

/// Compares 8-bit images, which must have the same size and not be empty. SSIM follows Wang, Bovik, Sheikh and Simoncelli, "Image quality
/// assessment: from error visibility to structural similarity", 2004. It is computed on luma with K1 = 0.01, K2 = 0.03 and an 11 x 11 px
/// Gaussian window with a standard deviation of 1.5 px. At the image border the window is cropped and its weights are renormalized.
ImageDifference compare_images(const Image<glm::u8vec4>& a, const Image<glm::u8vec4>& b);
/// Compares images of linear light. All values must be finite. SSIM is computed after clamping to [0, 1] and sRGB encoding.
ImageDifference compare_images(const Image<glm::vec4>& a, const Image<glm::vec4>& b);

/// Returns the maximum difference over channels for each pixel. Both images must have the same size.
Image<float> difference_map(const Image<glm::u8vec4>& a, const Image<glm::u8vec4>& b);
Image<float> difference_map(const Image<glm::vec4>& a, const Image<glm::vec4>& b);

/// Maps differences to colors on a logarithmic scale: black for 0, blue at 1/255, then red and yellow, and white at 1 and above.
Image<glm::u8vec4> difference_colors(const Image<float>& differences);

}  // namespace halfspace::HS_LANES
