// SPDX-License-Identifier: Apache-2.0
//
// Clusters of a draw that are hidden. Input: the bounds of clusters and of the depth buffer. Output: those that cannot pass the depth test.
#pragma once

#include "halfspace/raster/depth_pyramid.h"
#include "halfspace/raster/primitives/cluster_boxes.h"
#include "halfspace/raster/primitives/primitive_assembly.h"

namespace halfspace::HS_LANES {

/// Returns true if a fragment of the draw that fails the depth test changes nothing, and if its depth is between those of the corners of
/// its triangle.
bool can_hide(const Draw& draw);

/// Finds the hidden clusters of a draw with ClusterCulling::hidden_by for which can_hide() is true.
class HiddenClusters {
 public:
  explicit HiddenClusters(const Draw& draw);

  /// Returns those of the clusters first + i, for all bits i of `candidates`, that are hidden. first: a multiple of the SIMD width.
  uint32_t among(uint32_t candidates, const Clusters& clusters, std::size_t first) const;

 private:
  const DepthPyramid& pyramid_;
  Viewport viewport_;
  PixelBounds bounds_;
  CompareOp compare_;
  ClipDepth clip_;
  Computed x_, y_, z_, w_;
};

}  // namespace halfspace::HS_LANES
