// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace::HS_LANES {

/// Estimates the detail that a height map loses on coarser meshes. The error is the 99.9th percentile of the absolute difference
/// between the map and the map averaged to fewer columns.
class ReliefDetail {
 public:
  /// `smoothing` is the value passed to HeightField, in texels. Detail removed by smoothing does not count as an error.
  ReliefDetail(const Image<float>& map, double smoothing, const Workers& workers);

  /// Returns the error in the unit of the map, for `columns` ≥ 1 along u. The error is interpolated linearly between successive
  /// halvings of the map, which tends to overestimate it.
  double error(double columns) const;

 private:
  struct Level {
    double columns, error;
  };
  std::vector<Level> levels_;  // in order of decreasing columns, starting at the map's width
};

}  // namespace halfspace::HS_LANES
