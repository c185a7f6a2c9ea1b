// SPDX-License-Identifier: Apache-2.0
//
// Depth of a triangle at the samples of a tile.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "halfspace/raster/tile/tile_format.h"
#include "halfspace/raster/visibility/coverage/tile_edges.h"
#include "halfspace/raster/visibility/tests/depth_bounds.h"

namespace halfspace::HS_LANES {

/// Bounds of a triangle's depth in rectangles of a tile. If the triangle is large and seen at an angle, these bounds are much tighter than
/// those of the whole triangle.
class DepthInTile {
 public:
  /// samples_at: range of the sample positions within a pixel.
  DepthInTile(const Triangle& t, const Draw& draw, const Tile& tile, const SampleSpan& samples_at)
      : format_(tile.depth_format),
        low_(std::clamp(t.z0, draw.depth_low, draw.depth_high)),
        high_(std::clamp(t.z_max, draw.depth_low, draw.depth_high)),
        is_plane_(t.is_triangle()) {
    if (!is_plane_) return;
    const int middle = (samples_at.low + samples_at.high) / 2;
    const double z0 = static_cast<double>(t.z0), z1 = static_cast<double>(t.z_edge1), z2 = static_cast<double>(t.z_edge2);
    const double e1x = t.x[1] - t.x[0], e1y = t.y[1] - t.y[0], e2x = t.x[2] - t.x[0], e2y = t.y[2] - t.y[0];
    const double x = tile.x0 * kSubPixels + middle - t.x[0], y = tile.y0 * kSubPixels + middle - t.y[0];
    const double by_x = e2y * z1 - e1y * z2, by_y = e1x * z2 - e2x * z1;
    z_ = z0 + by_x * x + by_y * y;
    step_x_ = by_x * kSubPixels;
    step_y_ = by_y * kSubPixels;
    // The first term is four times the rounding error of DepthPlane, whose terms are not negative in covered pixels. The second term
    // exceeds the rounding error of this class in any pixel of the tile.
    const double reach = kMaxTileSize * kSubPixels;
    const double terms = (std::abs(e2y) * z1 + std::abs(e1y) * z2) * (std::abs(x) + reach) +
                         (std::abs(e1x) * z2 + std::abs(e2x) * z1) * (std::abs(y) + reach);
    margin_ = 0x1p-20 * (2 * std::abs(z0) + std::abs(static_cast<double>(t.z_max))) + 0x1p-48 * terms;
    margin_ += (std::abs(by_x) + std::abs(by_y)) * ((samples_at.high - samples_at.low + 1) / 2);
  }

  /// Returns the bounds at all samples of a rectangle. x, y: its first pixel, numbered from the corner of the tile.
  HS_INLINE DepthBounds at(int x, int y, int width, int height) const {
    if (!is_plane_) return {depth_value(format_, low_), depth_value(format_, high_)};
    const double half_x = 0.5 * (width - 1), half_y = 0.5 * (height - 1);
    const double center = z_ + step_x_ * (x + half_x) + step_y_ * (y + half_y);
    const double reach = std::abs(step_x_) * half_x + std::abs(step_y_) * half_y + margin_;
    const auto value = [&](double z) { return depth_value(format_, std::clamp(static_cast<float>(z), low_, high_)); };
    return {value(center - reach), value(center + reach)};
  }

 private:
  DepthFormat format_;
  float low_, high_;  // of the whole triangle
  bool is_plane_;
  double z_ = 0, step_x_ = 0, step_y_ = 0;  // depth in the middle of the samples of pixel (0, 0), and its steps from pixel to pixel
  double margin_ = 0;                       // largest rounding error, plus the change of depth between the samples of a pixel
};

/// Depth planes: z0 + e1·z_edge1 + e2·z_edge2, clamped to [low, high]. e1 and e2 are the values of edges 1 and 2 without bias. Lanes are
/// triangles, or pixels of one triangle.
struct DepthPlane {
  Real z0, z_edge1, z_edge2, low, high;

  HS_INLINE Real at(DepthFormat format, Real e1, Real e2) const {
    return depth_value(format, clamp(fma(e1, z_edge1, fma(e2, z_edge2, z0)), low, high));
  }
  HS_INLINE Real at(DepthFormat format, Int e1, Int e2) const { return at(format, to_real<Real>(e1), to_real<Real>(e2)); }
};

/// Returns the depth plane of a primitive, for its pixels.
inline DepthPlane depth_plane(const Triangle& t, const Draw& draw) {
  const float low = t.is_line() ? std::clamp(t.z0, draw.depth_low, draw.depth_high) : draw.depth_low;
  const float high = std::clamp(t.z_max, draw.depth_low, draw.depth_high);
  return {Real(t.z0), Real(t.z_edge1), Real(t.z_edge2), Real(low), Real(high)};
}

/// Depth of a triangle or line that is not narrow. Its edge functions do not fit in int32, so they are computed in floating point.
class LargeDepthPlane {
 public:
  /// first: position of sample 0.
  LargeDepthPlane(const Triangle& t, const Draw& draw, const Tile& tile, SamplePosition first)
      : plane_(depth_plane(t, draw)),
        format_(tile.depth_format),
        e1x_(static_cast<float>(t.x[1] - t.x[0])),
        e1y_(static_cast<float>(t.y[1] - t.y[0])),
        e2x_(static_cast<float>(t.x[2] - t.x[0])),
        e2y_(static_cast<float>(t.y[2] - t.y[0])),
        dx_(tile.x0 * kSubPixels + first.x - t.x[0]),
        dy_(tile.y0 * kSubPixels + first.y - t.y[0]) {}

  /// Returns the depth at one pixel per lane. x, y: pixels, numbered from the corner of the tile; offset: position of the sample relative
  /// to that of sample 0.
  HS_INLINE Real at(Int x, Int y, SamplePosition offset = {0, 0}) const {
    const Real dx = to_real<Real>(x * kSubPixels + (dx_ + offset.x)), dy = to_real<Real>(y * kSubPixels + (dy_ + offset.y));
    return plane_.at(format_, difference_of_products(dx, Real(e2y_), dy, Real(e2x_)),
                     difference_of_products(Real(e1x_), dy, Real(e1y_), dx));
  }

 private:
  DepthPlane plane_;
  DepthFormat format_;
  float e1x_, e1y_, e2x_, e2y_;
  int32_t dx_, dy_;  // from the first vertex to sample 0 of pixel (0, 0)
};

/// Depth of a primitive in the packets of a tile. narrow: the primitive has kNarrow.
template <bool narrow, bool multisampled>
class PacketDepth {
 public:
  /// The arguments must outlive this object.
  PacketDepth(const Triangle& t, const Draw& draw, const Tile& tile, const SampleSet<multisampled>& samples,
              const TileEdges<multisampled>& edges)
      : plane_(make_plane(t, draw, tile, samples)), samples_(samples), edges_(edges), format_(tile.depth_format) {}

  /// Returns the depth of the packet with corner (x, y), numbered from the corner of the tile, at sample s.
  HS_INLINE Real at(std::size_t s, int x, int y) const {
    if constexpr (narrow) {
      return plane_.at(format_, edges_.values(1, s, x, y) + edges_.bias(1), edges_.values(2, s, x, y) + edges_.bias(2));
    } else {
      return plane_.at(lane_x() + x, lane_y() + y, samples_.offset(s));
    }
  }

 private:
  static auto make_plane(const Triangle& t, const Draw& draw, [[maybe_unused]] const Tile& tile,
                         [[maybe_unused]] const SampleSet<multisampled>& samples) {
    if constexpr (narrow) {
      return depth_plane(t, draw);
    } else {
      return LargeDepthPlane(t, draw, tile, samples.position[0]);
    }
  }

  std::conditional_t<narrow, DepthPlane, LargeDepthPlane> plane_;
  const SampleSet<multisampled>& samples_;
  const TileEdges<multisampled>& edges_;
  DepthFormat format_;
};

}  // namespace halfspace::HS_LANES
