// SPDX-License-Identifier: Apache-2.0
//
// Visibility of lines that are one pixel wide. Such a line covers one pixel of each column, or of each row if it is y-major, so its pixels
// are computed one by one instead of testing blocks. The row wireframe took 0.83x the time, lines 0.92x (964283f1).
#pragma once

#include <cmath>

#include "halfspace/raster/pipeline/line.h"
#include "halfspace/raster/visibility/coverage/depth_plane.h"

namespace halfspace::HS_LANES {

/// Finds the covered pixel of each column or row. A sample is covered if it is between the two edges of the line (see BandEdge), whose
/// distance along the minor axis is exactly one pixel.
class ThinLine {
 public:
  /// line: a primitive of kind line, drawn one pixel wide.
  explicit ThinLine(const Triangle& line)
      : y_major_(is_y_major(line.x[1] - line.x[0], line.y[1] - line.y[0])),
        major0_(y_major_ ? line.y[0] : line.x[0]),
        minor0_(y_major_ ? line.x[0] : line.y[0]),
        major_delta_((y_major_ ? line.y[1] : line.x[1]) - major0_),
        minor_delta_((y_major_ ? line.x[1] : line.y[1]) - minor0_) {
    if (major_delta_ < 0) {
      major_delta_ = -major_delta_;
      minor_delta_ = -minor_delta_;
    }
    // The bias of the lower edge: a line through pixel centers belongs to the pixels on the side to which it is moved (line.h).
    low_bias_ = !y_major_ && minor_delta_ > 0 ? 1 : 0;
  }

  bool y_major() const { return y_major_; }
  bool is_empty() const { return major_delta_ == 0; }

  /// Returns the row of the line's pixel in column i, or its column in row i if the line is y-major. Rounding the quotient to double cannot
  /// move it to the next integer: it is below 2^15, and its distance from an integer is 0 or at least 2^-32.
  int minor(int i) const {
    const int64_t along = int64_t{i} * kSubPixels + kSubPixels / 2 - major0_;
    const int64_t above = int64_t{major_delta_} * (minor0_ - kSubPixels) + int64_t{minor_delta_} * along + low_bias_;
    return static_cast<int>(std::ceil(static_cast<double>(above) / static_cast<double>(int64_t{major_delta_} * kSubPixels)));
  }

 private:
  bool y_major_;
  int32_t major0_, minor0_, major_delta_, minor_delta_, low_bias_;
};

/// Tests and writes the pixels of a line in a tile with one sample per pixel. bounds: see line_bounds().
template <class Writer>
void rasterize_thin_line(const DrawInTile& d, const Triangle& t, const PixelBounds& bounds, TriangleId id, Writer& writer) {
  const ThinLine line(t);
  if (line.is_empty()) return;
  const LargeDepthPlane plane(t, d.draw, d.tile, kPixelCenter);
  const int begin = line.y_major() ? bounds.y0 : bounds.x0, end = line.y_major() ? bounds.y1 : bounds.x1;
  const int low = line.y_major() ? bounds.x0 : bounds.y0, high = line.y_major() ? bounds.x1 : bounds.y1;
  const int first_major = line.y_major() ? d.tile.y0 : d.tile.x0, first_minor = line.y_major() ? d.tile.x0 : d.tile.y0;
  alignas(64) std::array<int32_t, kLanes> major{}, minor{}, pixels;
  alignas(64) std::array<float, kLanes> depths;
  for (int i = begin; i < end;) {
    std::size_t count = 0;
    for (; i < end && count < static_cast<std::size_t>(kLanes); ++i) {
      const int j = line.minor(i);
      major[count] = i - first_major;
      minor[count] = j - first_minor;
      count += j >= low && j < high ? 1 : 0;
    }
    const Int along = load<Int>(major.data()), across = load<Int>(minor.data());
    const Int x = line.y_major() ? across : along, y = line.y_major() ? along : across;
    store(pixels.data(), pixel_at(x, y));
    store(depths.data(), plane.at(x, y));
    for (std::size_t k = 0; k < count; ++k) writer.write_pixel(id, static_cast<std::size_t>(pixels[k]), depths[k]);
  }
}

}  // namespace halfspace::HS_LANES
