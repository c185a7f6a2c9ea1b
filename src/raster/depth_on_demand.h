// SPDX-License-Identifier: Apache-2.0
//
// A depth image of which only those tiles are drawn that a later pass reads. Of a shadow map, a view often reads a small part.
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

class DepthOnDemand {
 public:
  /// Runs the stages of the pass up to binning. The pass must have one layer, one sample, a depth target with an image that is stored, no
  /// color target, and no draw with a tessellation or geometry function, a query, a timer or a condition. What its draws refer to must stay
  /// valid and unchanged until the object is destroyed. If the triangles exceed PassTuning::bin_budget, all tiles are drawn at once.
  DepthOnDemand(Pass pass, const Workers& workers);
  ~DepthOnDemand();
  DepthOnDemand(const DepthOnDemand&) = delete;
  DepthOnDemand& operator=(const DepthOnDemand&) = delete;

  /// The tiles of the depth image. A tile has the same contents as after Pass::run() once it was required; before, its contents are
  /// unspecified. Valid as long as this object.
  const TilesOnDemand& tiles() const;

  /// Draws all tiles that are missing, for those who read the image itself.
  void draw_all(const Workers& workers) const;

  /// Statistics of the pass, with the tiles that were drawn so far. Must not be called while a pass runs that requires tiles.
  PassStatistics statistics() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace halfspace::HS_LANES
