// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/hidden_clusters.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "halfspace/raster/pipeline/window.h"

namespace halfspace::HS_LANES {

namespace {

// Bounds of the quotient of two functions in W boxes, as a vertex function and the viewport transform compute it.
struct Quotient {
  Real low, high;

  // The quotient of two linear functions has its extrema at corners. Its error is that of the dividend and the quotient times that of the
  // divisor, over the divisor, and as large here as in the shader. 2^-20: the roundings of the divisions and of the error.
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
  return s.depth.test && compares && !s.depth.clamp && !s.stencil && s.polygon_mode == PolygonMode::fill &&
         !has_offset(s.offset, s.polygon_mode) && !s.polygon_smooth && !draw.kernels.writes_depth;
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
  std::array<Quotient, 3> ndc;
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
  const auto inside = [&](const Quotient& q, float low, float high) {
    return (q.low > Real(0.999f * low)) & (q.high < Real(0.999f * high));
  };
  whole = whole & inside(ndc[0], viewport_.guard_left, viewport_.guard_right) & inside(ndc[1], viewport_.guard_bottom, viewport_.guard_top);
  candidates &= bits(whole);
  if (candidates == 0) return 0;

  // The window coordinates, with more than the rounding errors of the viewport transform. Vertices are snapped by up to 1/512 px.
  const auto window = [](const Quotient& q, float scale, float center, float error) {
    const Real a = fma(q.low, Real(scale), Real(center)), b = fma(q.high, Real(scale), Real(center));
    return Quotient{min(a, b) - Real(error), max(a, b) + Real(error)};
  };
  const Quotient x = window(ndc[0], viewport_.half_width, viewport_.center_x, 1.0f / 64.0f);
  const Quotient y = window(ndc[1], viewport_.half_height, viewport_.center_y, 1.0f / 64.0f);
  const Quotient z = window(ndc[2], viewport_.depth_scale, viewport_.depth_bias, 0x1p-22f);
  alignas(64) std::array<std::array<float, kLanes>, 6> at;
  for (std::size_t k = 0; k < 6; ++k) {
    const Quotient& q = k < 2 ? x : k < 4 ? y : z;
    store(at[k].data(), k % 2 == 0 ? q.low : q.high);
  }
  const bool is_reversed = compare_ == CompareOp::greater || compare_ == CompareOp::greater_equal;
  uint32_t hidden = 0;
  for (uint32_t left = candidates; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    const auto pixel = [&](std::size_t k) { return static_cast<int>(std::floor(at[k][i])); };
    const int x0 = std::max(pixel(0), bounds_.x0), x1 = std::min(pixel(1) + 1, bounds_.x1);
    const int y0 = std::max(pixel(2), bounds_.y0), y1 = std::min(pixel(3) + 1, bounds_.y1);
    bool is_hidden = x0 >= x1 || y0 >= y1;
    if (!is_hidden) {
      const DepthPyramid::Bounds stored = pyramid_.bounds(x0, y0, x1, y1);
      is_hidden = is_reversed ? at[5][i] < stored.low : at[4][i] > stored.high;
    }
    if (is_hidden) hidden |= left & (~left + 1);
  }
  return hidden;
}

}  // namespace halfspace::HS_LANES
