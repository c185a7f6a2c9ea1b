// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/loop/pass_plan.h"

#include <algorithm>
#include <utility>

#include "halfspace/raster/primitives/cull_clusters.h"
#include "halfspace/raster/primitives/setup.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace::HS_LANES {

namespace {

// Number of primitives per chunk. The first chunks are small, so that all threads have work in a small pass. Later chunks grow with the
// number of preceding primitives: since each tile has to visit all chunks, a large pass should have few of them.
constexpr uint64_t kSmallestChunk = 2048;
constexpr uint64_t kChunkShare = 8;

}  // namespace

void PassPlan::add(const Draw& draw, std::size_t number) {
  const bool is_conditional = draw.state.condition.has_value();
  if (is_conditional && (draw.primitive_count == 0 || draw.state.instances == 0)) {
    if (draw.state.query) submitted.add_to_query(*draw.state.query, 0);
    return;
  }
  has_timers |= draw.state.timer.has_value();
  if (is_conditional) begin_conditional(*draw.state.condition, number);
  PassStatistics& counters = is_conditional ? conditional_draws.back().submitted : submitted;
  if (draw.state.query) {
    submitted.add_to_query(*draw.state.query, 0);  // also if it is not drawn
    counters.add_to_query(*draw.state.query, 0, std::size_t{draw.primitive_count} * draw.state.instances);
    open_queries_.push_back(*draw.state.query);
  }
  if (!draw.is_emitted) counters.vertices_in += (draw.indices->size() - draw.indices->restarts().size()) * draw.state.instances;
  if (draw.state.clusters) {
    add_clusters(draw, number, counters);
  } else {
    add_vertices(draw, number, counters);
    for (uint32_t instance = 0; instance < draw.state.instances; ++instance)
      add_primitives(draw, number, instance, 0, draw.primitive_count);
  }
  if (!is_conditional) return;
  conditional_draws.back().end_chunk = chunks.size();
  end_chunk();
}

void PassPlan::begin_conditional(const DrawCondition& condition, std::size_t number) {
  const bool waits = std::ranges::find(open_queries_, condition.query) != open_queries_.end();
  if (waits) open_queries_.clear();
  conditional_draws.push_back({condition, number, chunks.size(), chunks.size(), waits, {}});
  end_chunk();
}

void PassPlan::end_chunk() {
  capacity_ = 0;
  starts_task_ = true;
}

void PassPlan::add_clusters(const Draw& draw, std::size_t number, PassStatistics& counters) {
  const VisibleClusters visible = visible_clusters(draw);
  counters.vertices_shaded += visible.vertex_count;
  const uint64_t culled = draw.primitive_count - visible.triangle_count;
  counters.primitives_in += culled;
  counters.culled_cluster += culled;
  for (const IndexRange& r : visible.vertices) add_parts(draw, number, r.begin, r.end, &r == visible.vertices.data());
  for (const IndexRange& r : visible.triangles)
    add_primitives(draw, number, 0, static_cast<uint32_t>(r.begin), static_cast<uint32_t>(r.end));
  starts_task_ = true;  // a task of small draws would shade the vertices of this one, too
}

void PassPlan::add_parts(const Draw& draw, std::size_t number, std::size_t begin, std::size_t end, bool is_first) {
  for (std::size_t b = begin; b < end; b += kVerticesPerTask)
    vertex_tasks.push_back(
        {number, number + 1, b, std::min(end, b + kVerticesPerTask), true, is_first && b == begin ? shaded_bytes(draw) : 0});
}

void PassPlan::add_vertices(const Draw& draw, std::size_t number, PassStatistics& counters) {
  const std::size_t count = draw.vertex_count;
  if (!draw.is_emitted) counters.vertices_shaded += count;
  if (count > kVerticesPerTask) return add_parts(draw, number, 0, count, true);
  if (!vertex_tasks.empty() && !std::exchange(starts_task_, false)) {
    VertexTask& last = vertex_tasks.back();
    if (!last.is_part && last.end + count <= kVerticesPerTask) {
      last.end_draw = number + 1;
      last.end += count;
      last.bytes += shaded_bytes(draw);
      return;
    }
  }
  vertex_tasks.push_back({number, number + 1, 0, count, false, shaded_bytes(draw)});
}

void PassPlan::add_primitives(const Draw& draw, std::size_t number, uint32_t instance, uint32_t begin, uint32_t end) {
  const uint32_t each = max_triangles_per_primitive(draw, samples_);
  for (uint32_t first = begin; first < end;) {
    if (capacity_ == 0 || records_ < each) {
      chunks.emplace_back();
      capacity_ = static_cast<uint32_t>(std::min<uint64_t>(chunk_triangles_, std::max(kSmallestChunk, primitives_ / kChunkShare)));
      records_ = kMaxTrianglesPerChunk;
    }
    const uint32_t n = std::min({capacity_, records_ / each, end - first});
    chunks.back().push_back({static_cast<uint32_t>(number), instance, first, n});
    first += n;
    primitives_ += n;
    capacity_ -= n;
    records_ -= n * each;
  }
}

}  // namespace halfspace::HS_LANES
