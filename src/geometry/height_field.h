// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace::HS_LANES {

/// The value of a height field at one point, and its derivatives with respect to u and v, each of which spans the map from 0 to 1.
struct HeightSample {
  double value, du, dv;
};

/// The four columns that contribute to the height at some u, and their weights for the value and for its derivative per texel.
struct HeightTaps {
  std::array<int, 4> column;
  std::array<double, 4> value, slope;
};

/// Continuation of a map beyond its edges, named after the surface that the map covers.
///   sphere    u is periodic; across a pole the map continues half a turn away: g(u, −v) = g(u + 1/2, v)
///   torus     u and v are periodic: the map tiles
///   cylinder  u is periodic; the first and last rows are repeated
///   sheet     the edge texels are repeated
enum class MapEdges : uint8_t { sphere, torus, cylinder, sheet };

/// A height map as a smooth function of (u, v). Row 0 is at v = 0 (north on a sphere) and column 0 begins at u = 0. The function is the
/// uniform cubic B-spline with the texels, at their centers, as control points. It is twice continuously differentiable, even across edges,
/// stays within the range of the texels, and reproduces constants and ramps. Results depend only on the map and the arguments, bit for bit.
class HeightField {
 public:
  /// `map` may be in any unit; width ≥ 2 and height ≥ 1. On a sphere, a map with an odd width is resampled to one fewer column, because
  /// half a turn must be an integer number of texels. `smoothing` ≥ 0 is the standard deviation of a Gaussian in texels: about 1 for a
  /// sharp map, 2 to 3 to remove the terraces of 8-bit maps. On a sphere it is measured in texels at the equator and has the same length
  /// along u and v. A row at v is smoothed along u by smoothing / sin πv texels, so that the compressed texels near the poles do not turn
  /// into noise.
  HeightField(const Image<float>& map, double smoothing, const Workers& workers, MapEdges edges = MapEdges::sphere);

  int width() const { return texels_.width(); }
  int height() const { return texels_.height(); }

  /// Returns the lowest and the highest texel. All heights are between them.
  std::pair<double, double> range() const;

  /// Returns the height at any u and at v in [−1, 2]. Where u is periodic, the results for u and u + 1 are bit-identical if both numbers
  /// are exact, such as 0 and 1. The same applies to v and v + 1 on a torus.
  HeightSample at(double u, double v) const;

  /// Batched evaluation at a single v, bit-identical to at(u, v). The taps of a column can be reused for all rows of a map.
  HeightTaps taps(double u) const;
  void at(std::span<const HeightTaps> taps, double v, std::span<HeightSample> samples) const;

  /// Evaluates at the texel centers of a row, one sample per column. Equals at() up to rounding of the coordinates.
  void at_texels(int row, std::span<HeightSample> samples) const;

  /// Returns the field for a tessellation of `max_width` ≥ 2 sectors, or for a map of that width. A wider field is box filtered to
  /// the largest even width ≤ max_width with the same aspect ratio. On a sphere it is also smoothed along u towards the poles,
  /// where texels crowd, by 0.5 / tan πv texels.
  HeightField filtered(int max_width, const Workers& workers) const;

 private:
  HeightField() = default;

  // Texels are stored relative to base_, one of the texels of the map, so that a constant map stays exactly constant.
  float base_ = 0.0f;
  MapEdges edges_ = MapEdges::sphere;
  Image<float> texels_;
};

}  // namespace halfspace::HS_LANES
