// SPDX-License-Identifier: Apache-2.0
//
// A depth image of which only those tiles are drawn that a later pass reads. A view often reads only a small part of a shadow map.
//
//   Pass shadow(2048, 2048, ColorTarget{}, d32f_target(map));
//   shadow.draw_depth(...);
//   const DepthOnDemand demand(std::move(shadow), workers);  // shades the vertices and bins the triangles
//   MyShader shader{map.data(), &demand.tiles(), ...};       // calls tiles->require() before it reads the map
//   pass.draw(shader, ...);
//   pass.run(workers);                                       // draws the tiles of the map that it reads
#pragma once

#include <memory>

#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/tiles_on_demand.h"

namespace halfspace::HS_LANES {

/// The shaded vertices, the triangles and the bins of the pass stay in memory until the object is destroyed.
class DepthOnDemand {
 public:
  /// Runs the stages of the pass up to binning. The pass must have one layer, one sample, a depth target with an image that is stored, no
  /// color target, and no draw with a tessellation or geometry function, a query, a timer or a condition; this is checked. If the pass
  /// needs several rounds (PassTuning::bin_budget), all tiles are drawn at once. Only the constructor uses `workers`.
  ///
  /// The image and what the draws refer to must stay valid until the object is destroyed, and what the draws refer to must not change.
  /// Until draw_all() has returned, nothing else may write the image, and it may only be read where tiles have been required.
  ///
  /// The shaders of the pass run on threads that shade fragments of other passes. They must not wait for tasks of a task scheduler.
  DepthOnDemand(Pass pass, const Workers& workers);
  ~DepthOnDemand();
  DepthOnDemand(const DepthOnDemand&) = delete;
  DepthOnDemand& operator=(const DepthOnDemand&) = delete;

  /// The tiles of the depth image. Once a tile has been required, its contents are those after Pass::run(); before, they are unspecified.
  /// If a shader of the pass throws, TilesOnDemand::require() throws the same exception. Valid as long as this object.
  const TilesOnDemand& tiles() const;

  /// Draws all tiles that are missing, for code that reads the image directly: a pass that loads it, a DepthPyramid, or a function that
  /// saves it.
  void draw_all(const Workers& workers) const;

  /// Returns statistics of the pass, with the tiles that have been drawn so far. Thread-safe.
  PassStatistics statistics() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace halfspace::HS_LANES
