// SPDX-License-Identifier: Apache-2.0
//
// The work of a pass, in the order of its draws. Input: the draws. Output: tasks for the vertex stage, and the primitives of each chunk.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/statistics.h"

namespace halfspace::HS_LANES {

/// Vertices that one thread shades: a part of the vertices of a large draw, or all vertices of the small draws [draw, end_draw).
struct VertexTask {
  std::size_t draw, end_draw;
  std::size_t begin, end;  ///< range of the vertices used by the draw; for small draws, end is the total number of vertices
  bool is_part;
  std::size_t bytes;  ///< that the shaded vertices of its draws need; 0 for all parts of a draw but the first
};

/// A plan. It does not depend on the number of threads.
class PassPlan {
 public:
  /// samples: per pixel; chunk_triangles: see PassTuning.
  PassPlan(int samples, uint32_t chunk_triangles) : samples_(samples), chunk_triangles_(chunk_triangles) {}

  /// Adds a draw. number: of the draw in its pass.
  void add(const Draw& draw, std::size_t number);

  std::vector<VertexTask> vertex_tasks;
  std::vector<std::vector<DrawRange>> chunks;
  PassStatistics submitted;  ///< what is known before the pass runs

 private:
  void add_vertices(const Draw& draw, std::size_t number);
  void add_primitives(const Draw& draw, std::size_t number);

  int samples_;
  uint32_t chunk_triangles_;
  uint64_t primitives_ = 0;  // in all chunks
  uint32_t capacity_ = 0;    // primitives that still fit in the last chunk
  uint32_t records_ = 0;     // triangles that still fit in the last chunk
};

}  // namespace halfspace::HS_LANES
