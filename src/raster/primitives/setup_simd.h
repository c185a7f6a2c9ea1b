// SPDX-License-Identifier: Apache-2.0
//
// Setup of W triangles at once: small ones that need no clipping, which are most. The same results as primitive_setup's.
#pragma once

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace {

class TriangleBatch {
 public:
  /// May triangles of the draw come here? Not with a depth offset, which asks each for its slope.
  static bool serves(const Draw& draw);

  /// The vertices' slots of all triangles: 3·count indices (count 1 to W) less base. Lanes beyond repeat the last.
  void put_list(const uint32_t* indices, int count, uint32_t base);
  /// The same, where they follow each other: first, first + 1, …, less base.
  void put_sequence(uint32_t first, int count, uint32_t base);
  /// What was put.
  std::array<uint32_t, 3> slots(int lane) const {
    const auto slot = [&](std::size_t i) { return static_cast<uint32_t>(vertex_[i][static_cast<std::size_t>(lane)]); };
    return {slot(0), slot(1), slot(2)};
  }
  /// The vertices' slots of a triangle.
  void put(int lane, const std::array<uint32_t, 3>& slots) {
    for (std::size_t i = 0; i < 3; ++i) vertex_[i][static_cast<std::size_t>(lane)] = static_cast<int32_t>(slots[i]);
  }

  /// Sets up the triangles of `lanes`, whose vertices need no clipping; put() has told the vertices of lane 0 to W − 1. Counts
  /// those it culls. provoking: 0 or 2, the provoking vertex's place. segment: the chunk's that they are of.
  void set_up(const PassContext& context, const Draw& draw, const ShadedVertices& shaded, uint32_t lanes, uint32_t provoking,
              uint32_t range, PassStatistics& statistics);

  uint32_t kept() const { return kept_; }    ///< lanes that are set up
  uint32_t large() const { return large_; }  ///< lanes that are too large for it: nothing is said of them
  /// Writes the kept lanes' triangles, of which there is one at least, to out, in order.
  void write(Triangle* out) const;

 private:
  alignas(64) std::array<std::array<int32_t, kLanes>, 3> vertex_;
  // Of the kept triangles, as Triangle has them:
  std::array<Int, 3> x_, y_, ordered_vertex_;
  Real z0_, z_edge1_, z_edge2_, z_max_;
  Int flags_;
  uint32_t kept_ = 0, large_ = 0;
};

}  // namespace halfspace
