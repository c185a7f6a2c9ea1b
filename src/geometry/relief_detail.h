// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace {

/// What a map of heights loses on coarser meshes: by how much heights averaged to fewer columns differ from the map, at all but a
/// thousandth of its texels.
class ReliefDetail {
 public:
  /// `smoothing`: HeightField's, texels; detail that it takes away is none.
  ReliefDetail(const Image<float>& map, double smoothing, const Workers& workers);

  /// In the map's unit, for `columns` ≥ 1 along u; on a straight line between the halvings of the map, which is too much rather than too
  /// little.
  double error(double columns) const;

 private:
  struct Level {
    double columns, error;
  };
  std::vector<Level> levels_;  // from the map's own width (error 0) downwards
};

}  // namespace halfspace
