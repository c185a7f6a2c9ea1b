// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/pipeline/line.h"

#include <algorithm>
#include <cmath>

namespace halfspace::HS_LANES {

namespace {

constexpr int kHalf = kSubPixels / 2;
constexpr int kLastPixel = 1 << 15;

// Returns the first pixel along an axis whose center is at or after x.
int first_center(int64_t x) { return static_cast<int>((x - kHalf + kSubPixels - 1) >> kSubPixelBits); }

// Returns true if the pixel's diamond, |x − cx| + |y − cy| < 1/2 px, contains the point moved by (−ε, −ε²).
bool diamond_holds(int64_t px, int64_t py, int64_t x, int64_t y) {
  const int64_t u = x - (px * kSubPixels + kHalf), v = y - (py * kSubPixels + kHalf);
  const int64_t sum = std::abs(u) + std::abs(v);
  return sum < kHalf || (sum == kHalf && u > 0);
}

// Returns the pixel along an axis that contains x − ε.
int64_t pixel_before(int64_t x) { return (x - 1) >> kSubPixelBits; }

}  // namespace

LineRange line_range(const ScreenVertex& a, const ScreenVertex& b, int pixels) {
  const bool y_major = is_y_major(int64_t{b.x} - a.x, int64_t{b.y} - a.y);
  const auto major = [&](const ScreenVertex& v) { return y_major ? v.y : v.x; };
  // Returns true if the diamond of pixel i along the major axis contains the end point.
  const int64_t shift = int64_t{kHalf} * (pixels - 1);  // a wide line consists of one-pixel lines; offset to the lowest one
  const auto holds = [&](const ScreenVertex& v, int i) {
    const int64_t x = y_major ? v.x - shift : v.x, y = y_major ? v.y : v.y - shift;
    return y_major ? diamond_holds(pixel_before(x), i, x, y) : diamond_holds(i, pixel_before(y), x, y);
  };
  const int from = first_center(major(a)), to = first_center(major(b));
  // Covers the pixels whose centers are between the end points. The first pixel is also covered if the line starts in the far half of its
  // diamond. The last pixel is not covered if the line ends in its diamond.
  int first = 0, end = 0;
  if (major(a) < major(b)) {
    first = from - (holds(a, from - 1) ? 1 : 0);
    end = to - (holds(b, to - 1) ? 1 : 0);
  } else {
    first = to + (holds(b, to) ? 1 : 0);
    end = from + (holds(a, from) ? 1 : 0);
  }
  first = std::clamp(first, 0, kLastPixel);
  return {first, std::clamp(end, first, kLastPixel)};
}

std::array<BandEdge, 2> band_edges(const Triangle& t, int pixels) {
  int32_t dx = t.x[1] - t.x[0], dy = t.y[1] - t.y[0];
  const bool y_major = is_y_major(dx, dy);
  if ((y_major ? dy : dx) < 0) {
    dx = -dx;
    dy = -dy;
  }
  const int64_t offset = int64_t{y_major ? dy : dx} * kHalf * pixels;
  const Edge forward{t.x[0], t.y[0], dx, dy};  // > 0 above an x-major line, to the left of a y-major one
  const Edge backward{t.x[0], t.y[0], -dx, -dy};
  // Moving an x-major line by (−ε, −ε²) raises it if its slope is positive and lowers it otherwise. A y-major line moves to the left.
  const bool raised = y_major || dy > 0;
  return {BandEdge{forward, offset, raised ? 1 : 0}, {backward, offset, raised ? 0 : 1}};
}

PixelBounds line_bounds(const Triangle& t, int pixels, const PixelBounds& b) {
  const bool y_major = is_y_major(t.x[1] - t.x[0], t.y[1] - t.y[0]);
  const LineRange range = t.line_range();
  const auto [low, high] = y_major ? std::minmax(t.x[0], t.x[1]) : std::minmax(t.y[0], t.y[1]);
  // Beyond its end points, a line with a slope of at most 45° extends by at most one pixel.
  const int across0 = (low >> kSubPixelBits) - pixels / 2 - 2, across1 = (high >> kSubPixelBits) + pixels / 2 + 3;
  if (y_major) return {std::max(b.x0, across0), std::max(b.y0, range.first), std::min(b.x1, across1), std::min(b.y1, range.end)};
  return {std::max(b.x0, range.first), std::max(b.y0, across0), std::min(b.x1, range.end), std::min(b.y1, across1)};
}

}  // namespace halfspace::HS_LANES
