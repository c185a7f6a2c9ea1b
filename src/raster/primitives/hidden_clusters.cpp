// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/hidden_clusters.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "halfspace/raster/pipeline/window.h"

namespace halfspace::HS_LANES {

namespace {

// Bounds of a value in W boxes, as a vertex function and the viewport transform compute it.
struct Range {
  Real low, high;

  // The range of f / w at the corners of the boxes becomes that in the boxes. w is positive there, so the extrema are at corners. If the
  // computed f and w have the errors e_f and e_w, f / w has the error (e_f + |f / w| · e_w) / w, here and in the shader. 2^-20: the
  // roundings of the divisions and of the error.
  void widen(const Computed& f, Real error_w, Real w_low, const Boxes& boxes) {
    const Real largest = max(abs(low), abs(high));
    const Real error = Real(2.02f) * (error_bound(f, boxes) + largest * error_w) / w_low + Real(0x1p-20f) * largest;
    low -= error;
    high += error;
  }
};

Real value_at(const Plane& p, const std::array<Real, 3>& corner) { return dot(p.normal, corner) + Real(p.offset); }

}  // namespace

bool can_hide(const Draw& draw) {
  const DrawState& s = draw.state;
  const bool compares = s.depth.compare == CompareOp::less || s.depth.compare == CompareOp::less_equal ||
                        s.depth.compare == CompareOp::greater || s.depth.compare == CompareOp::greater_equal;
  return s.depth.test && compares && !s.depth.clamp && s.polygon_mode == PolygonMode::fill && !has_offset(s.offset, s.polygon_mode) &&
         !s.polygon_smooth && !draw.kernels.writes_depth;
}

HiddenClusters::HiddenClusters(const Draw& draw)
    : pyramid_(*draw.state.clusters->hidden_by),
      viewport_(draw.viewport),
      bounds_(draw.bounds),
      compare_(draw.state.depth.compare),
      clip_(draw.state.depth.clip) {
  const ClipTransform transform(*draw.state.clusters);
  x_ = transform.computed(0);
  y_ = transform.computed(1);
  z_ = transform.computed(2);
  w_ = transform.computed(3);
}

// The depth of a covered sample is at least that of the nearest corner of its triangle, and at most that of the farthest (DepthPlane), if
// the triangle is not clipped. The corners of all triangles of a cluster are in its box, so bounds of the depth in the box are bounds of
// all depths that the cluster can have. In the same way, the pixels that it can cover are bounded.
uint32_t HiddenClusters::among(uint32_t candidates, const Clusters& clusters, std::size_t first) const {
  const Boxes boxes = load_boxes(clusters, first);
  const auto value = [&](std::size_t v) { return load<Real>(clusters.values(static_cast<Clusters::Value>(v)) + first); };
  Real w_low(std::numeric_limits<float>::infinity());
  std::array<Range, 3> ndc;
  ndc.fill({Real(std::numeric_limits<float>::infinity()), Real(-std::numeric_limits<float>::infinity())});
  for (uint32_t c = 0; c < 8; ++c) {
    std::array<Real, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = value((c >> k & 1 ? Clusters::kHighX : Clusters::kLowX) + k);
    const Real w = value_at(w_.plane, corner);
    w_low = min(w_low, w);
    for (std::size_t k = 0; k < 3; ++k) {
      const Real q = value_at((k == 0 ? x_ : k == 1 ? y_ : z_).plane, corner) / w;
      ndc[k].low = min(ndc[k].low, q);
      ndc[k].high = max(ndc[k].high, q);
    }
  }
  const Real error_w = error_bound(w_, boxes);
  w_low -= error_w;
  ndc[0].widen(x_, error_w, w_low, boxes);
  ndc[1].widen(y_, error_w, w_low, boxes);
  ndc[2].widen(z_, error_w, w_low, boxes);

  // No triangle is clipped.
  const float nearest = clip_ == ClipDepth::negative_one_to_one ? -1.0f : 0.0f;
  Mask whole = (w_low > Real(2.0f * kMinW)) & (ndc[2].low > Real(nearest)) & (ndc[2].high < Real(1.0f));
  const auto inside = [&](const Range& q, float low, float high) {
    return (q.low > Real(low + 0.001f * std::fabs(low))) & (q.high < Real(high - 0.001f * std::fabs(high)));
  };
  whole = whole & inside(ndc[0], viewport_.guard_left, viewport_.guard_right) & inside(ndc[1], viewport_.guard_bottom, viewport_.guard_top);
  candidates &= bits(whole);
  if (candidates == 0) return 0;

  // The window coordinates, widened by more than the rounding errors of the viewport transform and of snapping (1/512 px).
  const auto window = [](const Range& q, float scale, float center, float error) {
    const Real a = fma(q.low, Real(scale), Real(center)), b = fma(q.high, Real(scale), Real(center));
    return Range{min(a, b) - Real(error), max(a, b) + Real(error)};
  };
  const Range x = window(ndc[0], viewport_.half_width, viewport_.center_x, 1.0f / 64.0f);
  const Range y = window(ndc[1], viewport_.half_height, viewport_.center_y, 1.0f / 64.0f);
  const Range z = window(ndc[2], viewport_.depth_scale, viewport_.depth_bias, 0x1p-22f);
  struct Lanes {
    alignas(64) std::array<float, kLanes> low, high;
    explicit Lanes(const Range& r) {
      store(low.data(), r.low);
      store(high.data(), r.high);
    }
  };
  const Lanes x_at(x), y_at(y), z_at(z);
  const bool is_reversed = compare_ == CompareOp::greater || compare_ == CompareOp::greater_equal;
  uint32_t hidden = 0;
  for (uint32_t left = candidates; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    const auto pixel = [](float v) { return static_cast<int>(std::floor(v)); };
    const int x0 = std::max(pixel(x_at.low[i]), bounds_.x0), x1 = std::min(pixel(x_at.high[i]) + 1, bounds_.x1);
    const int y0 = std::max(pixel(y_at.low[i]), bounds_.y0), y1 = std::min(pixel(y_at.high[i]) + 1, bounds_.y1);
    bool is_hidden = x0 >= x1 || y0 >= y1;
    if (!is_hidden) {
      const DepthPyramid::Bounds stored = pyramid_.bounds(x0, y0, x1, y1);
      is_hidden = is_reversed ? z_at.high[i] < stored.low : z_at.low[i] > stored.high;
    }
    if (is_hidden) hidden |= 1u << i;
  }
  return hidden;
}

}  // namespace halfspace::HS_LANES
