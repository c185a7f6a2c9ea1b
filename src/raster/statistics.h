// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace halfspace {

/// What a pass did. Every count is exact, and the same for any number of threads and any lane width.
struct PassStatistics {
  uint64_t vertices_in = 0;        ///< indices submitted, in all instances; restarts are none
  uint64_t vertices_shaded = 0;    ///< distinct vertices referenced, per draw
  uint64_t primitives_in = 0;      ///< triangles submitted
  uint64_t culled_non_finite = 0;  ///< a position with NaN or Inf
  uint64_t culled_outside = 0;     ///< wholly beyond one plane of the view volume, or nothing left after clipping
  uint64_t culled_face = 0;        ///< by CullMode
  uint64_t culled_degenerate = 0;  ///< zero area after snapping
  uint64_t culled_no_sample =
      0;                 ///< no sample inside its bounds, viewport and scissor; of one sample a pixel and at most 4 x 4: none covered
  uint64_t clipped = 0;  ///< triangles that a clip plane cut
  uint64_t triangles_binned = 0;  ///< triangles that reached the tiles (a clipped one may count several times)
  uint64_t bin_entries = 0;       ///< triangle-tile pairs
  uint64_t samples_tested = 0;    ///< covered samples tested one by one (8x8 blocks rejected whole are not in it)
  uint64_t samples_passed = 0;    ///< of these, those that passed (with discard: were kept and passed)
  uint64_t fragments_shaded = 0;  ///< runs of the fragment function, masked lanes not counted
  uint64_t tiles_touched = 0;     ///< tiles that any triangle reached
  uint64_t flushes = 0;           ///< times the bins outgrew their budget before the end of the pass

  /// Occlusion queries: the samples that passed all tests, of the draws whose DrawState::query was this number.
  std::vector<uint64_t> queries;
  bool any_passed(std::size_t query) const { return queries[query] != 0; }
  void add_to_query(std::size_t query, uint64_t samples);

  PassStatistics& operator+=(const PassStatistics& o);
  friend bool operator==(const PassStatistics&, const PassStatistics&) = default;
};

}  // namespace halfspace
