// SPDX-License-Identifier: Apache-2.0
#include "oracle/window.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "oracle/smooth_area.h"

namespace halfspace::oracle {

Point center_of(int x, int y) { return {int64_t{x} * 256 + 128, int64_t{y} * 256 + 128}; }

Point position_of(const Sample& s, int samples) {
  // In 1/16 px, from the standard sample locations in the Vulkan specification.
  static const std::vector<std::pair<int, int>> two{{12, 12}, {4, 4}}, four{{6, 2}, {14, 6}, {2, 10}, {10, 14}},
      eight{{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}};
  if (samples == 1) return center_of(s.x, s.y);
  const auto [x, y] = (samples == 2 ? two : samples == 4 ? four : eight)[static_cast<std::size_t>(s.number)];
  return {int64_t{s.x} * 256 + x * 16, int64_t{s.y} * 256 + y * 16};
}

namespace {

Box box_of(const Rect& r) { return {r.x, r.y, int64_t{r.x} + r.width, int64_t{r.y} + r.height}; }

// The smallest and largest coordinates of samples in their pixel, in 1/256 px.
std::pair<double, double> sample_range(int samples) {
  double low = 256.0, high = 0.0;
  for (int s = 0; s < samples; ++s) {
    const Point p = position_of({0, 0, s}, samples);
    low = std::fmin(low, static_cast<double>(std::min(p.x, p.y)));
    high = std::fmax(high, static_cast<double>(std::max(p.x, p.y)));
  }
  return {low, high};
}

// The pixels that may have a sample in a viewport, based on the bounding box of the sample positions.
Box box_of(const ViewportRect& r, int samples) {
  const auto [low, high] = sample_range(samples);
  const auto first = [](double x, double place) { return static_cast<int64_t>(std::ceil(x - place / 256.0)); };
  const double left = static_cast<double>(r.x), right = left + static_cast<double>(r.width);
  const double a = static_cast<double>(r.y), b = a + static_cast<double>(r.height);
  return {first(left, high), first(std::fmin(a, b), high), first(right, low), first(std::fmax(a, b), low)};
}

}  // namespace

Box intersect(const Box& a, const Box& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

bool is_front_facing(const DrawState& state, bool counter_clockwise) {
  const bool expects_counter_clockwise = state.front == Winding::counter_clockwise;
  return (counter_clockwise == expects_counter_clockwise) != (state.clip_origin == ClipOrigin::upper_left);
}

Box allowed_pixels(const Framebuffer& target, const DrawState& state) {
  Box b{0, 0, target.width(), target.height()};
  if (state.viewport) b = intersect(b, box_of(*state.viewport, target.samples()));
  if (state.scissor) b = intersect(b, box_of(*state.scissor));
  return b;
}

Box covered_box(const WindowTriangle& t, int samples) {
  if (!t.smooth.empty()) return smooth_box(t.smooth);
  if (t.is_line) {
    const int64_t margin = t.width / 2 + 3;
    const auto [xl, xh] = std::minmax(t.from.x, t.to.x);
    const auto [yl, yh] = std::minmax(t.from.y, t.to.y);
    return {xl / 256 - margin, yl / 256 - margin, xh / 256 + margin, yh / 256 + margin};
  }
  if (t.is_point) return {t.low.x / 256 - 2, t.low.y / 256 - 2, t.high.x / 256 + 2, t.high.y / 256 + 2};
  const auto [low_place, high_place] = sample_range(samples);
  const double low = low_place, high = high_place;  // lambdas cannot capture structured bindings
  const auto [xl, xh] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
  const auto [yl, yh] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
  const auto first = [&](int64_t v) { return static_cast<int64_t>(std::ceil((static_cast<double>(v) - high) / 256.0)); };
  const auto last = [&](int64_t v) { return static_cast<int64_t>(std::floor((static_cast<double>(v) - low) / 256.0)); };
  return {first(xl), first(yl), last(xh) + 1, last(yh) + 1};
}

bool is_small(const WindowTriangle& t) {
  constexpr int64_t extent = 63 * 256;
  const auto [xl, xh] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
  const auto [yl, yh] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
  return xh - xl <= extent && yh - yl <= extent;
}

}  // namespace halfspace::oracle
