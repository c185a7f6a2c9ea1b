// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace {

/// A height field at one place: the map's value and its derivatives by the map's coordinates, each of which spans
/// the whole map from 0 to 1.
struct HeightSample {
  double value, du, dv;
};

/// The four texels of a row that a place along u takes its height from, and their weights: for the value, and for its slope by a texel.
struct HeightTaps {
  std::array<int, 4> column;
  std::array<double, 4> value, slope;
};

/// How a map goes on beyond its edges, by what it is wrapped round.
///   sphere    u is periodic; over a pole it goes on half a turn further on: g(u, −v) = g(u + 1/2, v)
///   torus     u and v are periodic: a map that tiles
///   cylinder  u is periodic, the first and last row go on
///   sheet     the texels at the edges go on
enum class MapEdges : uint8_t { sphere, torus, cylinder, sheet };

/// A map as a smooth function of (u, v): row 0 is v = 0, the north of a sphere, column 0 begins at u = 0. The surface is
/// the uniform cubic B-spline with the texels (at their centres) as control points, so it is twice continuously
/// differentiable, also over the edges, stays within the texels' range and follows constants and ramps. The bits of all
/// results depend on the map and the arguments alone.
class HeightField {
 public:
  /// `map` has any unit, width ≥ 2 and height ≥ 1; on a sphere an odd width is resampled to one texel less, as half a turn
  /// must be whole texels. `smoothing` ≥ 0 is the standard deviation of a Gaussian in texels: about 1 for a sharp map; the
  /// terraces of 8-bit maps need 2 to 3. On a sphere these are texels of the equator, the same length along u and v: a row
  /// at v is smoothed along u by smoothing / sin πv texels, so that the many texels round a pole are not noise.
  HeightField(const Image<float>& map, double smoothing, const Workers& workers, MapEdges edges = MapEdges::sphere);

  int width() const { return texels_.width(); }
  int height() const { return texels_.height(); }

  /// Any u; v in [−1, 2]. Where u is periodic, u and u + 1 give the same bits wherever both are exact, 0 and 1 among them;
  /// so do v and v + 1 on a torus.
  HeightSample at(double u, double v) const;

  /// Many places of one v, with the same bits as one by one: taps of their u are found once for all rows of a map.
  HeightTaps taps(double u) const;
  void at(std::span<const HeightTaps> taps, double v, std::span<HeightSample> samples) const;

  /// At the centres of a row's texels; samples: one a column. What at() gives but for the rounding of its coordinates.
  void at_texels(int row, std::span<HeightSample> samples) const;

  /// The field for a tessellation of `max_width` ≥ 2 sectors, or for a map of that width: where this one is wider, it is
  /// averaged by area to the largest even width that is not above it, in the same proportion, and on a sphere smoothed
  /// along u towards the poles (by half a texel / tan πv), where texels crowd.
  HeightField filtered(int max_width, const Workers& workers) const;

 private:
  HeightField() = default;

  // What is kept are differences from one texel, which makes a constant map exactly constant.
  float base_ = 0.0f;
  MapEdges edges_ = MapEdges::sphere;
  Image<float> texels_;
};

}  // namespace halfspace
