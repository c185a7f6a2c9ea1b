// SPDX-License-Identifier: Apache-2.0
#include "halfspace/reference/inside_error.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

InsideError inside_error(const PictureOfObjects& picture, const PictureOfObjects& truth) {
  const std::size_t count = truth.objects.texels().size();
  const auto check_size = [&](const auto& image) {
    HS_CHECK(image.width() == truth.objects.width() && image.height() == truth.objects.height(),
             "inside_error: the images have different sizes; expected the same size");
  };
  check_size(picture.objects);
  check_size(picture.colors);
  check_size(truth.colors);
  InsideError error;
  int64_t sum = 0;
  std::array<int64_t, 256> pixels{};  // number of inside pixels by their largest difference
  for (std::size_t i = 0; i < count; ++i) {
    const int object = truth.objects.texels()[i];
    if (picture.objects.texels()[i] != object) {
      ++error.differing;
      continue;
    }
    if (object == 0) continue;
    int largest = 0;
    for (int k = 0; k < 3; ++k) {
      const int difference = std::abs(int{picture.colors.texels()[i][k]} - int{truth.colors.texels()[i][k]});
      sum += difference;
      largest = std::max(largest, difference);
    }
    ++error.inside;
    ++pixels[static_cast<std::size_t>(largest)];
  }
  if (error.inside == 0) return error;
  error.mean = static_cast<double>(sum) / (3.0 * static_cast<double>(error.inside));
  // The smallest difference that at least 99 of 100 inside pixels do not exceed.
  int64_t below = 0;
  int code = 0;
  while ((below += pixels[static_cast<std::size_t>(code)]) * 100 < error.inside * 99) ++code;
  error.p99 = code;
  return error;
}

}  // namespace halfspace::HS_LANES
