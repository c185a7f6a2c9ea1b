// SPDX-License-Identifier: Apache-2.0
//
// How far two pictures are from each other, in numbers and as a picture.
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/image.h"

namespace halfspace {

/// Differences of red, green and blue, and of alpha where it is not 1 throughout both pictures. Codes count as code/255.
struct ImageDifference {
  int channels = 3;
  double rmse = 0.0;     ///< root of the mean square, over all channels
  double mean = 0.0;     ///< of the absolute differences
  double psnr_db = 0.0;  ///< 20·log10(1/rmse); infinite where nothing differs
  double max = 0.0;      ///< of any channel
  double p999 = 0.0;     ///< 99.9th percentile over pixels of the largest difference of a channel: so much or less differ 99.9 % of them
  double share_above = 0.0;  ///< share of the pixels where a channel differs by more than 1/255
  double ssim = 1.0;         ///< mean structural similarity: 1 where nothing differs
};

/// Compares 8-bit codes. Both of one size, not empty. SSIM is that of Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment:
/// from error visibility to structural similarity", 2004: on luma, a Gaussian window of 11 x 11 px and 1.5 px standard deviation,
/// K1 = 0.01, K2 = 0.03; at the picture's border the part of the window that lies inside.
ImageDifference compare_images(const Image<glm::u8vec4>& a, const Image<glm::u8vec4>& b);
/// Compares linear light; all finite. SSIM looks at it held to [0, 1] and encoded to sRGB.
ImageDifference compare_images(const Image<glm::vec4>& a, const Image<glm::vec4>& b);

/// The largest difference of a channel at each pixel. Both of one size.
Image<float> difference_map(const Image<glm::u8vec4>& a, const Image<glm::u8vec4>& b);
Image<float> difference_map(const Image<glm::vec4>& a, const Image<glm::vec4>& b);

/// A map of differences as colours on a logarithmic scale, black for none over blue (1/255), red and yellow to white (1 and more).
Image<glm::u8vec4> difference_colors(const Image<float>& differences);

}  // namespace halfspace
