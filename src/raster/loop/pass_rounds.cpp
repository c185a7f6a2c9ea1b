// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/loop/pass_rounds.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "halfspace/raster/pipeline/draw_stopwatch.h"
#include "halfspace/raster/pipeline/pass_memory.h"
#include "halfspace/raster/primitives/bin.h"
#include "halfspace/raster/primitives/primitive_stage.h"
#include "halfspace/raster/primitives/setup.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace::HS_LANES {

namespace {

// Number of chunks that are set up between checks of the budget.
constexpr std::size_t kChunksPerSet = 32;

Chunk take_or_make(std::vector<Chunk>& from) {
  if (from.empty()) return {};
  Chunk c = std::move(from.back());
  from.pop_back();
  return c;
}
// Clears all chunks and moves them to `to`, in reverse order. take_or_make() then returns them in the original order, so that each chunk is
// reused with memory of about the right size.
void recycle_chunks(std::vector<Chunk>& chunks, std::vector<Chunk>& to) {
  for (auto c = chunks.rbegin(); c != chunks.rend(); ++c) {
    c->clear();
    to.push_back(std::move(*c));
  }
  chunks.clear();
}

class PassRounds {
 public:
  PassRounds(PassContext& context, PassPlan& plan, std::size_t budget, const Workers& workers)
      : context_(context), plan_(plan), budget_(budget), workers_(workers), memory_(take_pass_memory()) {
    context_.shaded = std::move(memory_.shaded);
    context_.shaded.resize(context_.draws.size());
  }

  // Sets up the chunks of the next round. statistics: with the queries of all rounds before. Returns true if it is the last one.
  bool set_up(PassStatistics& statistics) {
    decide_conditional_draws(statistics);
    skip_chunks();
    recycle_chunks(context_.chunks, memory_.chunks);
    context_.triangle_ids.assign(context_.draws.size(), {});
    shade_more_vertices(statistics);
    set_up_chunks(statistics);
    return next_chunk_ == plan_.chunks.size();
  }

  // Decides about conditional draws after the last chunk, of which nothing is drawn. Must be called after the last round. Returns the
  // memory that was not needed.
  PassMemory finish(PassStatistics& statistics) {
    decide_conditional_draws(statistics);
    return std::move(memory_);
  }

 private:
  // Decides about the next conditional draws, up to one that waits for chunks of the next round.
  void decide_conditional_draws(PassStatistics& statistics) {
    std::size_t executed = next_chunk_;  // the chunks before are executed or not drawn
    for (; decided_ < plan_.conditional_draws.size(); ++decided_) {
      const ConditionalDraw& d = plan_.conditional_draws[decided_];
      if (d.waits && d.begin_chunk != executed) return;
      const bool passed = d.condition.query < statistics.queries.size() && statistics.any_passed(d.condition.query);
      if (passed != d.condition.inverted) {
        statistics += d.submitted;
      } else {
        skipped_.push_back(d.draw);
        if (d.begin_chunk == executed) executed = d.end_chunk;
      }
    }
  }
  bool is_skipped(std::size_t draw) const { return std::ranges::binary_search(skipped_, draw); }
  // Passes the conditional draws that start at the next chunk and are decided. Returns false if the next chunk is not decided.
  bool skip_chunks() {
    for (; next_conditional_ < plan_.conditional_draws.size(); ++next_conditional_) {
      const ConditionalDraw& d = plan_.conditional_draws[next_conditional_];
      if (d.begin_chunk != next_chunk_) return true;
      if (next_conditional_ == decided_) return false;
      if (is_skipped(d.draw)) next_chunk_ = d.end_chunk;
    }
    return true;
  }
  // The chunk at which the next conditional draw starts, and the first draw that is not decided.
  std::size_t next_conditional_chunk() const {
    return next_conditional_ < plan_.conditional_draws.size() ? plan_.conditional_draws[next_conditional_].begin_chunk
                                                              : plan_.chunks.size();
  }
  std::size_t end_decided_draw() const {
    return decided_ < plan_.conditional_draws.size() ? plan_.conditional_draws[decided_].draw : context_.draws.size();
  }

  // Shades the vertices of the draws of the next chunk and, up to the budget, of the draws after it. The vertices of draws before the next
  // chunk are discarded.
  void shade_more_vertices(PassStatistics& statistics) {
    if (next_chunk_ == plan_.chunks.size()) return;
    const std::size_t first = plan_.chunks[next_chunk_].front().draw, last = plan_.chunks[next_chunk_].back().draw;
    if (last < end_shaded_) return;
    // The next draws take over the memory of the draws that are finished.
    std::size_t to = end_shaded_;
    for (; first_kept_ < std::min(first, end_shaded_); ++first_kept_) {
      ShadedVertices finished = std::exchange(context_.shaded[first_kept_], {});
      if (to < context_.shaded.size()) context_.shaded[to++] = std::move(finished);
    }
    const std::vector<VertexTask>& tasks = plan_.vertex_tasks;
    const std::size_t begin = next_task_, end_draw = end_decided_draw();
    for (std::size_t bytes = 0;
         next_task_ < tasks.size() && (tasks[next_task_].draw <= last || (bytes < budget_ && tasks[next_task_].draw < end_draw));) {
      const VertexTask& task = tasks[next_task_];
      bytes += task.bytes;
      end_shaded_ = task.end_draw;
      while (next_task_ < tasks.size() && tasks[next_task_].draw < end_shaded_) ++next_task_;
    }
    run_vertex_stage(std::span(tasks).subspan(begin, next_task_ - begin), statistics);
  }

  void run_vertex_stage(std::span<const VertexTask> tasks, PassStatistics& statistics) {
    for (const VertexTask& t : tasks) {
      if (t.is_first_part() && !is_skipped(t.draw)) allocate_vertices(context_.draws[t.draw], context_.shaded[t.draw]);
    }
    std::vector<Outcode> any(tasks.size());  // union of the outcodes, for parts of large draws
    std::vector<PassStatistics> times(plan_.has_timers ? tasks.size() : 1);
    workers_.for_each(static_cast<int>(tasks.size()), [&](int i) {
      const VertexTask& t = tasks[static_cast<std::size_t>(i)];
      if (is_skipped(t.draw)) return;
      PassStatistics& time = times[plan_.has_timers ? static_cast<std::size_t>(i) : 0];  // unused without timers
      if (t.is_part) {
        const DrawStopwatch stopwatch(context_.draws[t.draw], &DrawTime::setup, time);
        any[static_cast<std::size_t>(i)] = shade_vertices(context_.draws[t.draw], t.begin, t.end, context_.shaded[t.draw]);
        return;
      }
      for (std::size_t d = t.draw; d < t.end_draw; ++d) {
        ShadedVertices& shaded = context_.shaded[d];
        const DrawStopwatch stopwatch(context_.draws[d], &DrawTime::setup, time);
        allocate_vertices(context_.draws[d], shaded);
        shaded.any_outcode = shade_vertices(context_.draws[d], 0, context_.draws[d].vertex_count, shaded);
      }
    });
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (tasks[i].is_part) context_.shaded[tasks[i].draw].any_outcode |= any[i];
    }
    for (const PassStatistics& time : times) statistics += time;
  }

  bool is_shaded(std::size_t chunk) const { return chunk < plan_.chunks.size() && plan_.chunks[chunk].back().draw < end_shaded_; }

  // Sets up the next chunks of the plan, until the budget is reached, all chunk ids are in use or no chunks with shaded vertices are left.
  void set_up_chunks(PassStatistics& statistics) {
    std::size_t bytes = 0;
    while (skip_chunks() && is_shaded(next_chunk_) && (context_.chunks.empty() || bytes < budget_) &&
           context_.chunks.size() + kChunksPerSet <= kMaxChunks) {
      const std::size_t begin = context_.chunks.size(), end = next_conditional_chunk();
      std::size_t count = 1;
      while (count < kChunksPerSet && next_chunk_ + count < end && is_shaded(next_chunk_ + count)) ++count;
      for (std::size_t i = 0; i < count; ++i) context_.chunks.push_back(take_or_make(memory_.chunks));
      workers_.for_each(static_cast<int>(count), [&](int i) {
        Chunk& chunk = context_.chunks[begin + static_cast<std::size_t>(i)];
        chunk.ranges = std::move(plan_.chunks[next_chunk_ + static_cast<std::size_t>(i)]);
        const auto start = plan_.has_timers ? std::chrono::steady_clock::now() : std::chrono::steady_clock::time_point{};
        set_up_chunk(context_, chunk);
        run_primitive_stage(context_, chunk);
        bin_chunk(context_, chunk);
        if (plan_.has_timers) add_times(chunk, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      });
      next_chunk_ += count;
      for (std::size_t c = begin; c < context_.chunks.size(); ++c) {
        bytes += context_.chunks[c].bytes();
        statistics += context_.chunks[c].statistics;
        add_triangle_ids(static_cast<uint32_t>(c));
      }
    }
  }

  // Divides the seconds that a chunk has taken among its draws.
  void add_times(Chunk& chunk, double seconds) const {
    const auto primitives = static_cast<double>(chunk.statistics.primitives_in);
    for (const DrawRange& r : chunk.ranges) {
      const std::optional<uint32_t>& timer = context_.draws[r.draw].state.timer;
      if (timer) chunk.statistics.add_time(*timer, {.setup = seconds * r.count / primitives});
    }
  }

  // Extends context_.triangle_ids by the triangles of a chunk, which follow those of the chunks before it.
  void add_triangle_ids(uint32_t chunk) {
    const Chunk& c = context_.chunks[chunk];
    for (std::size_t range = 0; range < c.ranges.size(); ++range) {
      TriangleIds& ids = context_.triangle_ids[c.ranges[range].draw];
      if (ids.count == 0) ids.first = triangle_id(chunk, c.ranges[range].first_triangle);
      ids.count = triangle_id(chunk, c.end_triangle(range)) - ids.first;
    }
  }

  PassContext& context_;
  PassPlan& plan_;
  std::size_t budget_;
  const Workers& workers_;
  PassMemory memory_;
  std::size_t next_task_ = 0;   // the first vertex task that has not run
  std::size_t first_kept_ = 0;  // the vertices of draws [first_kept_, end_shaded_) are in memory
  std::size_t end_shaded_ = 0;
  std::size_t next_chunk_ = 0;
  std::size_t next_conditional_ = 0;  // the first conditional draw at or after the next chunk
  std::size_t decided_ = 0;           // number of conditional draws of which it is known whether they are drawn
  std::vector<std::size_t> skipped_;  // conditional draws that are not drawn
};

}  // namespace

PassStatistics run_rounds(PassContext& context, Attachments& attachments, PassPlan plan, std::size_t budget, TileRunner& tiles,
                          const Workers& workers, PassMemory& spare) {
  PassStatistics statistics = std::move(plan.submitted);
  context.inspects_primitives = tiles.inspects_primitives();
  PassRounds rounds(context, plan, budget, workers);
  Round round{.first = true, .last = false};
  do {
    round.last = rounds.set_up(statistics);
    if (!round.last) {
      keep_between_flushes(context, attachments);
      ++statistics.flushes;
    }
    tiles.run(context, attachments, round, workers, statistics);
    round.first = false;
  } while (!round.last);
  spare = rounds.finish(statistics);
  return statistics;
}

void release_rounds(PassContext& context, PassMemory spare) {
  recycle_chunks(context.chunks, spare.chunks);
  spare.shaded = std::exchange(context.shaded, {});
  return_pass_memory(std::move(spare));
}

}  // namespace halfspace::HS_LANES
