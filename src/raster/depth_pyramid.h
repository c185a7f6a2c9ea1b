// SPDX-License-Identifier: Apache-2.0
//
// Bounds of a depth buffer in blocks of pixels of growing size (Greene, Kass and Miller, "Hierarchical Z-buffer visibility", 1993). With
// them, a draw skips the clusters of triangles that are hidden by what an earlier pass has drawn.
//
//   first.run(workers);                                          // draws what is near, and stores the depth
//   const DepthPyramid pyramid(target_texels(depth), workers);
//   DepthTarget kept = depth;
//   kept.load = LoadOp::load;
//   Pass second(width, height, color, kept);
//   second.draw(shader, vertices, indices, {.clusters = ClusterCulling{&clusters, clip_from_world, world_from_object, &pyramid}});
#pragma once

#include <vector>

#include "halfspace/core/parallel.h"
#include "halfspace/core/texel_view.h"

namespace halfspace::HS_LANES {

class DepthPyramid {
 public:
  /// depth: one layer of d32f texels, row 0 at the bottom of the window (target_texels()). It is not kept.
  DepthPyramid(const ConstTexelView& depth, const Workers& workers);

  int width() const { return width_; }
  int height() const { return height_; }

  struct Bounds {
    float low, high;
  };
  /// Returns bounds of the depths of all pixels [x0, x1) x [y0, y1), a rectangle of at least one pixel inside of the depth buffer. They are
  /// those of up to 5 x 5 blocks that contain it.
  Bounds bounds(int x0, int y0, int x1, int y1) const;

 private:
  struct Level {
    int width, height;
    std::vector<Bounds> blocks;  // by rows
  };

  int width_, height_;
  std::vector<Level> levels_;  // level k has blocks of 2^k · kBlock pixels
};

}  // namespace halfspace::HS_LANES
