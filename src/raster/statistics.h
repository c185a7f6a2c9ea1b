// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Time that draws take, in seconds, summed over all threads. It lacks the blending of order-independent layers and tiles that a draw fills
/// with one color. Tiles that a shader requires (DepthOnDemand) are part of its shading.
struct DrawTime {
  double setup = 0.0;       ///< vertex functions, clipping, setup and binning; control, evaluation and geometry functions by the clock
  double visibility = 0.0;  ///< coverage, tests and visibility functions
  double shading = 0.0;     ///< fragment functions, blending and other writes of colors
  DrawTime& operator+=(const DrawTime& o);
  friend bool operator==(const DrawTime&, const DrawTime&) = default;
};

/// Counters of a pass, and times. The counters do not depend on the number of threads. samples_tested can vary with the SIMD width, because
/// it depends on which blocks are rejected by hierarchical Z. So can fragments_shaded, for draws that test depth again after the shader: it
/// depends on how many packets are queued before they are shaded.
struct PassStatistics {
  uint64_t vertices_in = 0;           ///< submitted indices, for all instances, without restarts
  uint64_t vertices_shaded = 0;       ///< distinct vertices used by each draw, for all instances, but for those of culled clusters
  uint64_t patches_in = 0;            ///< submitted patches
  uint64_t vertices_evaluated = 0;    ///< calls of evaluation functions
  uint64_t geometry_invocations = 0;  ///< calls of geometry functions
  uint64_t primitives_in = 0;      ///< submitted primitives; of draws with tessellation or a geometry function, those that these emit into
                                   ///< layers and viewports that exist
  uint64_t culled_non_finite = 0;  ///< a position, a clip distance or a cull distance is NaN or Inf
  uint64_t culled_outside = 0;     ///< completely outside one plane of the view volume, by a cull distance, or nothing left after clipping
  uint64_t culled_face = 0;        ///< by CullMode
  uint64_t culled_degenerate = 0;  ///< zero area or length after snapping
  /// As part of a cluster (DrawState::clusters). Scenes use clusters for large meshes that a frame before has drawn; otherwise, the
  /// vertices of these triangles are shaded, and the triangles are culled for another reason or, if they are hidden, binned.
  uint64_t culled_cluster = 0;
  /// No sample inside the bounding box, viewport and scissor. With one sample per pixel, triangles of at most 4 x 4 pixels are also counted
  /// here if they cover no sample.
  uint64_t culled_no_sample = 0;
  uint64_t clipped = 0;           ///< primitives that were cut by a clip plane
  uint64_t triangles_binned = 0;  ///< primitives added to bins; a clipped triangle may count several times
  uint64_t bin_entries = 0;       ///< primitive-tile pairs
  uint64_t samples_tested = 0;    ///< covered samples that were tested individually, not as part of a rejected 8x8 block
  uint64_t samples_passed = 0;    ///< samples that passed all tests and were not discarded before them
  uint64_t fragments_shaded = 0;  ///< fragment function invocations, excluding masked lanes
  uint64_t layers_merged = 0;     ///< fragments of order-independent draws that were merged, because their sample already had 8 layers
  uint64_t tiles_touched = 0;     ///< tiles with at least one primitive, counted again after each flush
  uint64_t flushes = 0;           ///< number of times the tiles were rendered before the end of the pass (PassTuning::bin_budget,
                                  ///< DrawState::condition)

  /// Results of occlusion queries: queries[i] is the number of samples that passed all tests in draws with DrawState::query = i.
  std::vector<uint64_t> queries;
  /// Primitives of these draws (GL_PRIMITIVES_GENERATED), counted as in primitives_in.
  std::vector<uint64_t> query_primitives;
  /// Returns true if any sample of the query passed. query must be less than queries.size().
  bool any_passed(std::size_t query) const { return queries[query] != 0; }
  /// Adds to the result of a query; resizes queries and query_primitives if needed.
  void add_to_query(std::size_t query, uint64_t samples, uint64_t primitives = 0);

  /// times[i] is the time of the draws with DrawState::timer = i. A draw that shares work with others has its share by the number of
  /// primitives. For these draws, the clock is read twice per tile and primitive, or group of narrow triangles.
  std::vector<DrawTime> times;
  /// Adds to the time of a timer; resizes times if needed.
  void add_time(std::size_t timer, const DrawTime& time);

  PassStatistics& operator+=(const PassStatistics& o);
  friend bool operator==(const PassStatistics&, const PassStatistics&) = default;
};

}  // namespace halfspace::HS_LANES
