// SPDX-License-Identifier: Apache-2.0
#include "oracle/coverage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "oracle/arithmetic.h"
#include "oracle/smooth_area.h"

namespace halfspace::oracle {

namespace {

__extension__ typedef __int128 Wide;
struct WidePoint {
  Wide x, y;
};

// Returns whether the segment intersects the open diamond |x| + |y| < h. Each of the four sides restricts the segment to an open interval.
bool meets_diamond(const WidePoint& a, const WidePoint& b, Wide h) {
  Wide low_n = -1, low_d = 1, high_n = 2, high_d = 1;
  for (const auto& [sx, sy] : {std::pair{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
    const Wide fa = sx * a.x + sy * a.y - h, fb = sx * b.x + sy * b.y - h;
    if (fa >= 0 && fb >= 0) return false;
    if (fa < 0 && fb < 0) continue;
    const Wide n = fa >= 0 ? fa : -fa, d = fa >= 0 ? fa - fb : fb - fa;
    if (fa >= 0 && n * low_d > low_n * d) {
      low_n = n;
      low_d = d;
    }
    if (fa < 0 && n * high_d < high_n * d) {
      high_n = n;
      high_d = d;
    }
  }
  return low_n * high_d < high_n * low_d;
}

// Returns whether a line of width 1 produces the pixel. Both endpoints are moved by (-e, -e^2).
bool produces(const Point& from, const Point& to, int64_t x, int64_t y) {
  const bool near_by = std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)}) < int64_t{1} << 19;
  const int bits = near_by ? 40 : 34;
  const auto moved = [&](const Point& p) {
    return WidePoint{(Wide{p.x - (x * 256 + 128)} << bits) - (Wide{1} << (bits / 2)), (Wide{p.y - (y * 256 + 128)} << bits) - 1};
  };
  const WidePoint a = moved(from), b = moved(to);
  const Wide h = Wide{128} << bits;
  const auto size = [](Wide v) { return v < 0 ? -v : v; };
  const bool ends_in_it = size(b.x) + size(b.y) < h;
  return !ends_in_it && meets_diamond(a, b, h);
}

bool line_covers(const WindowTriangle& t, int64_t x, int64_t y) {
  const int64_t dx = t.to.x - t.from.x, dy = t.to.y - t.from.y;
  const bool y_major = std::abs(dy) > std::abs(dx);
  // Reject pixels far from the line early.
  const auto along = static_cast<double>(y_major ? y * 256 + 128 - t.from.y : x * 256 + 128 - t.from.x);
  const double slope = static_cast<double>(y_major ? dx : dy) / static_cast<double>(y_major ? dy : dx);
  const double across = static_cast<double>(y_major ? x * 256 + 128 - t.from.x : y * 256 + 128 - t.from.y) - slope * along;
  if (std::fabs(across) > 128.0 * t.width + 512.0) return false;
  const int64_t shift = 128 * (t.width - 1);
  const Point from = y_major ? Point{t.from.x - shift, t.from.y} : Point{t.from.x, t.from.y - shift};
  const Point to = y_major ? Point{t.to.x - shift, t.to.y} : Point{t.to.x, t.to.y - shift};
  for (int k = 0; k < t.width; ++k) {
    if (produces(from, to, y_major ? x - k : x, y_major ? y : y - k)) return true;
  }
  return false;
}

}  // namespace

bool covers(const WindowTriangle& t, const Point& at) {
  if (!t.smooth.empty()) return smooth_area(t.smooth, at.x >> 8, at.y >> 8) > 0.0f;
  if (t.is_line) return line_covers(t, at.x >> 8, at.y >> 8);
  if (t.is_point) return at.x >= t.low.x && at.x < t.high.x && at.y >= t.low.y && at.y < t.high.y;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& a = t.corner[i];
    const Corner& b = t.corner[(i + 1) % 3];
    const int64_t e = cross(b.x - a.x, b.y - a.y, at.x - a.x, at.y - a.y);
    const int64_t to_right = -(b.y - a.y), upwards = b.x - a.x;  // change in e per step in this direction
    const bool inside = e != 0 ? e > 0 : to_right != 0 ? to_right > 0 : upwards > 0;
    if (!inside) return false;
  }
  return true;
}

bool covers_none_of_few(const WindowTriangle& t, const Box& box) {
  if (!is_small(t) || box.x1 - box.x0 > 4 || box.y1 - box.y0 > 4) return false;
  for (int64_t y = box.y0; y < box.y1; ++y) {
    for (int64_t x = box.x0; x < box.x1; ++x) {
      if (covers(t, position_of({static_cast<int>(x), static_cast<int>(y), 0}, 1))) return false;
    }
  }
  return true;
}

}  // namespace halfspace::oracle
