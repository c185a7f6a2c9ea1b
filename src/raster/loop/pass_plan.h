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

  bool is_first_part() const { return is_part && bytes != 0; }
};

/// A draw with a condition. Its vertices and primitives share no task and no chunk with other draws.
struct ConditionalDraw {
  DrawCondition condition;
  std::size_t draw;
  std::size_t begin_chunk, end_chunk;
  bool waits;                ///< draws with its query may be in the chunks before, after the last draw that waits
  PassStatistics submitted;  ///< what PassPlan::submitted has for other draws
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
  std::vector<ConditionalDraw> conditional_draws;
  PassStatistics submitted;  ///< what is known before the pass runs
  bool has_timers = false;   ///< a draw has DrawState::timer

 private:
  void begin_conditional(const DrawCondition& condition, std::size_t number);
  // The next draw starts a chunk and a task.
  void end_chunk();
  // Adds the clusters of a draw that are left.
  void add_clusters(const Draw& draw, std::size_t number, PassStatistics& counters);
  void add_vertices(const Draw& draw, std::size_t number, PassStatistics& counters);
  // Adds tasks for the vertices [begin, end) of a large draw.
  void add_parts(const Draw& draw, std::size_t number, std::size_t begin, std::size_t end, bool is_first);
  // Adds the primitives [begin, end) of an instance.
  void add_primitives(const Draw& draw, std::size_t number, uint32_t instance, uint32_t begin, uint32_t end);

  int samples_;
  uint32_t chunk_triangles_;
  uint64_t primitives_ = 0;             // in all chunks
  uint32_t capacity_ = 0;               // primitives that still fit in the last chunk
  uint32_t records_ = 0;                // triangles that still fit in the last chunk
  bool starts_task_ = false;            // the vertices of the next draw share no task with those before
  std::vector<uint32_t> open_queries_;  // of the draws since the last conditional draw that waits
};

}  // namespace halfspace::HS_LANES
