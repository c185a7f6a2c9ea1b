// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/loop/tile_draws.h"

#include <algorithm>
#include <optional>

#include "halfspace/raster/pipeline/draw_stopwatch.h"
#include "halfspace/raster/primitives/bin.h"
#include "halfspace/raster/shade/decide_queued.h"
#include "halfspace/raster/shade/shade_deferred.h"
#include "halfspace/raster/shade/shade_queued.h"
#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/full_tile.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

namespace {

// The triangles of a tile and their vertices are scattered in memory. Prefetch distances, in triangles:
constexpr std::size_t kTrianglesAhead = 16, kVerticesAhead = 3;

HS_INLINE void prefetch(const Triangle& t) {
  __builtin_prefetch(&t);
  __builtin_prefetch(&t.flags);  // may be in the next cache line
}

// Prefetches the data of a triangle's first vertex, for shading or for a visibility function. It must be inlined: GCC 12 regards a local
// function that only prefetches as free of side effects and removes calls to it, which makes points_100k 20 % slower.
HS_INLINE void prefetch_vertex(const PassContext& context, const Chunk& chunk, const Triangle& t) {
  if (t.is(kClipped)) return;
  const ShadedVertices& shaded = context.shaded[chunk.ranges[t.range()].draw];
  const auto count = static_cast<std::size_t>(shaded.varying_count);
  const float* row = shaded.varyings.get() + t.vertex[0] * count;
  __builtin_prefetch(&shaded.screen[t.vertex[0]]);
  __builtin_prefetch(row);
  __builtin_prefetch(row + count);
}

// Returns the number of narrow triangles at the start of a bin that belong to the same draw, at most W.
std::size_t narrow_run(const Chunk& chunk, std::span<const uint16_t> bin) {
  const std::size_t max_count = std::min(bin.size(), static_cast<std::size_t>(kLanes));
  const uint32_t range = chunk.triangles[bin[0]].range();
  std::size_t n = 0;
  while (n < max_count && chunk.triangles[bin[n]].is_narrow_triangle() && chunk.triangles[bin[n]].range() == range) ++n;
  return n;
}

bool prefers_greater(CompareOp compare) { return compare == CompareOp::greater || compare == CompareOp::greater_equal; }

class TileDraws {
 public:
  TileDraws(const PassContext& context, bool has_color, TileMemory& memory, PassStatistics& statistics, TileTrace* trace)
      : context_(context), has_color_(has_color), memory_(memory), statistics_(statistics), trace_(trace) {}

  void run(int tile_x, int tile_y) {
    Tile& tile = memory_.tile;
    memory_.queue.count = 0;
    std::optional<DrawInTile> here;
    FullTileOccluder occluder;
    for (uint32_t c = 0; c < context_.chunks.size(); ++c) {
      const Chunk& chunk = context_.chunks[c];
      const std::span<const uint16_t> bin = bin_of(chunk, tile_x, tile_y);
      const auto ahead = [&](std::size_t i) -> const Triangle& { return chunk.triangles[bin[std::min(i, bin.size() - 1)]]; };
      for (std::size_t i = 0; i < bin.size();) {
        const uint16_t t = bin[i];
        const Draw& draw = context_.draws[chunk.ranges[chunk.triangles[t].range()].draw];
        if (!here || &here->draw != &draw) begin_draw(draw, here);
        const uint64_t passed_before = statistics_.samples_passed;
        const std::size_t narrow = occluder.is_pending() ? 0 : narrow_run(chunk, bin.subspan(i));
        for (std::size_t k = i; k < i + std::max<std::size_t>(narrow, 1); ++k) {
          prefetch(ahead(k + kTrianglesAhead));
          if (here->fetches_vertices) prefetch_vertex(context_, chunk, ahead(k + kVerticesAhead));
        }
        if (narrow != 0) {
          begin_triangle(*here);
          i += draw_narrow(*here, c, bin.subspan(i, narrow));
        } else {
          const bool was_visible = occluder.is_visible();
          const bool is_done = draw_with_occluder(occluder, *here, c, t);
          pending_ |= was_visible && !occluder.is_visible();
          if (!is_done) {
            begin_triangle(*here);
            draw_triangle(*here, c, t);
          }
          ++i;
        }
        if (draw.state.query) statistics_.add_to_query(*draw.state.query, statistics_.samples_passed - passed_before);
      }
    }
    finish_draw(here);
    if (occluder.is_visible() && has_color_) {
      shade_full_tile(context_, occluder.triangle(), tile, memory_.shading, statistics_, trace_);
      return occluder.write_depth();
    }
    occluder.write();
    if (pending_ && has_color_) shade_deferred(context_, tile, memory_.shading, statistics_, trace_);
    write_layers();
  }

 private:
  void begin_draw(const Draw& draw, std::optional<DrawInTile>& here) {
    finish_draw(here);
    here.emplace(context_, draw, visibility_mode(draw), memory_.tile, trace_);
    timer_ = timer_of(draw);
    rasterize_ = rasterize_function(*here);
    rasterize_narrow_ = rasterize_narrow_function(*here);
    if (draw.layer_group != layer_group_) write_layers();
    layer_group_ = draw.layer_group;
    if (draw.state.order_independent && memory_.layers.empty()) memory_.layers.clear(prefers_greater(draw.state.depth.compare));
  }

  // Called before a triangle is drawn. Shades the pending pixels of the tile if the draw shades immediately.
  void begin_triangle(const DrawInTile& d) {
    if (d.mode == VisibilityMode::deferred && !pending_) {
      d.tile.visibility.fill(kNoTriangle);
      pending_ = true;
    }
    if (shades_later(d.mode)) return;
    if (pending_ && has_color_) shade_deferred(context_, d.tile, memory_.shading, statistics_, trace_);
    pending_ = false;
  }

  // Runs the shader for the packets in the queue, which belong to the draw.
  void finish_queue(const DrawInTile& d) {
    const DrawStopwatch stopwatch(timer_, shades_later(d.mode) ? &DrawTime::visibility : &DrawTime::shading, statistics_);
    if (shades_later(d.mode)) {
      decide_queued(d, memory_.queue, statistics_);
    } else {
      shade_queued(d, memory_.queue, memory_.layers, memory_.shading.output, memory_.shading.packed, statistics_);
    }
  }

  // Finishes the current draw, if any, before the next one or at the end of the tile.
  void finish_draw(const std::optional<DrawInTile>& d) {
    if (!d || memory_.queue.count == 0) return;
    const uint64_t passed_before = statistics_.samples_passed;
    finish_queue(*d);
    if (d->draw.state.query) statistics_.add_to_query(*d->draw.state.query, statistics_.samples_passed - passed_before);
  }

  // Draws narrow triangles of one draw, 1 to W. Returns how many were drawn, at least 1.
  std::size_t draw_narrow(const DrawInTile& d, uint32_t chunk, std::span<const uint16_t> indices) {
    const std::size_t count = [&] {
      const DrawStopwatch stopwatch(timer_, &DrawTime::visibility, statistics_);
      return rasterize_narrow_(d, chunk, indices, memory_.queue, statistics_);
    }();
    if (memory_.queue.is_full()) finish_queue(d);
    return count;
  }

  void draw_triangle(const DrawInTile& d, uint32_t chunk, uint16_t index) {
    const Triangle& t = context_.chunks[chunk].triangles[index];
    if (t.is_narrow_triangle()) {
      draw_narrow(d, chunk, {&index, 1});
      return;
    }
    {
      const DrawStopwatch stopwatch(timer_, &DrawTime::visibility, statistics_);
      rasterize_(d, t, triangle_id(chunk, index), memory_.queue, statistics_);
    }
    if (memory_.queue.is_full()) finish_queue(d);
  }

  bool draw_with_occluder(FullTileOccluder& occluder, const DrawInTile& d, uint32_t chunk, uint16_t index) {
    const DrawStopwatch stopwatch(timer_, &DrawTime::visibility, statistics_);
    return occluder.draw(d, chunk, index, statistics_);
  }

  // Blends the transparent layers over the colors of the tile. Pixels that are visible behind them have been shaded.
  void write_layers() {
    if (!memory_.layers.empty()) memory_.layers.write(memory_.tile.color[0]);
    if (trace_ != nullptr) trace_->write_layers(memory_.tile.color[0]);
  }

  const PassContext& context_;
  bool has_color_;
  TileMemory& memory_;
  PassStatistics& statistics_;
  TileTrace* trace_;
  const uint32_t* timer_ = nullptr;        // of the current draw
  RasterizeFunction rasterize_ = nullptr;  // of the current draw
  RasterizeNarrowFunction rasterize_narrow_ = nullptr;
  bool pending_ = false;      // Tile::visibility is in use: pixels may have been drawn that are not shaded yet
  uint32_t layer_group_ = 0;  // of the current draw
};

}  // namespace

void draw_tile(const PassContext& context, bool has_color, int tile_x, int tile_y, TileMemory& memory, PassStatistics& statistics,
               TileTrace* trace) {
  TileDraws(context, has_color, memory, statistics, trace).run(tile_x, tile_y);
}

}  // namespace halfspace::HS_LANES
