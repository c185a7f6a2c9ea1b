// SPDX-License-Identifier: Apache-2.0
//
// Bounds of a depth buffer in blocks of pixels of growing size (Greene, Kass and Miller, "Hierarchical Z-buffer visibility", 1993). With
// them, a draw skips the clusters of triangles that are hidden by what an earlier pass has drawn.
//
//   first.run(workers);                                          // draws what is near, and stores the depth
//   const DepthPyramid pyramid(depth, workers);
//   color.load = depth.load = LoadOp::load;
//   Pass second(width, height, color, depth);
//   second.draw(shader, vertices, indices, {.clusters = ClusterCulling{&clusters, clip_from_world, world_from_object, &pyramid}});
#pragma once

#include <cstddef>
#include <vector>

#include "halfspace/core/parallel.h"
#include "halfspace/raster/target.h"

namespace halfspace::HS_LANES {

class DepthPyramid {
 public:
  /// depth: a target that an earlier pass has stored, of the format d32f, with one sample and one layer. The pyramid keeps the address to
  /// compare it with that of other targets, but does not read the depth again.
  DepthPyramid(const DepthTarget& depth, const Workers& workers);

  /// Returns true if the pyramid was built from the texels of this target.
  bool is_of(const DepthTarget& depth) const;

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
  const std::byte* texels_;
  std::ptrdiff_t row_pitch_;
  std::vector<Level> levels_;  // level k has blocks of 2^k · kBlock pixels
};

}  // namespace halfspace::HS_LANES
