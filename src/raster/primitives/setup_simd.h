// SPDX-License-Identifier: Apache-2.0
//
// Setup of W triangles at a time, for narrow triangles that need no clipping (the common case). The results are the same as those of
// set_up_triangle().
#pragma once

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

class TriangleBatch {
 public:
  /// Returns true if the draw can use this class. It must consist of filled triangles without clip distances. Depth offsets are not
  /// supported, because they depend on the slope of each triangle.
  static bool serves(const Draw& draw);

  /// Sets the vertex slots of `count` triangles (1 to W), one per lane, to their indices − base. The other lanes repeat the last triangle.
  void put_list(const uint32_t* indices, int count, uint32_t base);
  /// The same for consecutive indices: first, first + 1, …
  void put_sequence(uint32_t first, int count, uint32_t base);
  /// Returns the vertex slots of a lane.
  std::array<uint32_t, 3> slots(int lane) const {
    const auto slot = [&](std::size_t i) { return static_cast<uint32_t>(vertex_[i][static_cast<std::size_t>(lane)]); };
    return {slot(0), slot(1), slot(2)};
  }
  /// Sets the vertex slots of a lane.
  void put(int lane, const std::array<uint32_t, 3>& slots) {
    for (std::size_t i = 0; i < 3; ++i) vertex_[i][static_cast<std::size_t>(lane)] = static_cast<int32_t>(slots[i]);
  }

  /// Sets up the triangles in `lanes`, whose vertices must not need clipping. The vertex slots of all W lanes must be set. Culled triangles
  /// are counted in statistics. provoking: position of the provoking vertex, 0 or 2. range: index of the draw range in the chunk.
  void set_up(const PassContext& context, const Draw& draw, const ShadedVertices& shaded, uint32_t lanes, uint32_t provoking,
              uint32_t range, PassStatistics& statistics);

  uint32_t kept() const { return kept_; }    ///< lanes that were set up
  uint32_t large() const { return large_; }  ///< lanes that were skipped because their triangle is too large
  /// Writes the kept triangles to out, in order. There must be at least one.
  void write(Triangle* out) const;

 private:
  alignas(64) std::array<std::array<int32_t, kLanes>, 3> vertex_;
  // Data of the kept triangles, as in Triangle:
  std::array<Int, 3> x_, y_, ordered_vertex_;
  Real z0_, z_edge1_, z_edge2_, z_max_;
  Int flags_;
  uint32_t kept_ = 0, large_ = 0;
};

}  // namespace halfspace::HS_LANES
