// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/loop/tile_worker.h"

#include <algorithm>
#include <chrono>
#include <concepts>
#include <memory>
#include <numeric>

#include "halfspace/raster/loop/constant_tiles.h"
#include "halfspace/raster/loop/tile_draws.h"
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/primitives/bin.h"
#include "halfspace/raster/shade/tile_memory.h"
#include "halfspace/raster/tile/resolve.h"
#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/coverage/area_coverage.h"

namespace halfspace::HS_LANES {

namespace {

// Returns true if a target is stored in its image between flushes. Otherwise it has a spill buffer.
template <class Target>
bool keeps_in_image(const PassContext& context, const Target& target) {
  return target.data != nullptr && is_stored(target) && target.samples == context.samples;
}

// Returns where a target is stored between flushes: in its image, or in the spill buffer if it has one.
template <class Target>
Target between_flushes(const PassContext& context, Target target, const std::vector<std::byte>& spill) {
  if (!spill.empty()) {
    target.data = const_cast<std::byte*>(spill.data());
    target.width = context.width;
    target.height = context.height;
    target.samples = context.samples;
    target.row_pitch = target.sample_pitch = 0;
  }
  target.load = LoadOp::load;
  target.store = StoreOp::store;
  if constexpr (std::same_as<Target, DepthTarget>) target.stencil_load.reset();
  return target;
}

bool clears(const ColorTarget& target) { return target.load == LoadOp::clear; }
bool clears(const DepthTarget& target) { return target.load == LoadOp::clear || stencil_load_of(target) == LoadOp::clear; }

class TileWorker {
 public:
  TileWorker(const PassContext& context, const Attachments& attachments, Round round, const TileRecords& records)
      : context_(context), attachments_(attachments), round_(round), trace_(records.trace), ms_(records.ms) {}

  void run(const Workers& workers, PassStatistics& statistics) const {
    std::vector<int> rows(static_cast<std::size_t>(context_.tiles_y));
    std::iota(rows.begin(), rows.end(), 0);
    if (is_alone()) rows = fill_constant_rows(workers, statistics);
    const int row_count = static_cast<int>(rows.size());
    const int length = std::clamp(context_.tiles_x * row_count / (workers.threads() * kTasksPerThread), 1, kMaxTilesPerTask);
    const int strips_x = (context_.tiles_x + length - 1) / length;
    std::vector<PassStatistics> by_strip(static_cast<std::size_t>(strips_x * row_count));
    workers.for_each(strips_x * row_count, [&](int i) {
      const int x0 = i % strips_x * length;
      run_strip(x0, std::min(x0 + length, context_.tiles_x), rows[static_cast<std::size_t>(i / strips_x)],
                by_strip[static_cast<std::size_t>(i)]);
    });
    for (const PassStatistics& s : by_strip) statistics += s;
  }
  void run_one(int tile_x, int tile_y, PassStatistics& statistics) const { run_strip(tile_x, tile_x + 1, tile_y, statistics); }

 private:
  // A task processes several adjacent tiles of a row, so that tiles with the same color are filled together: writing a few hundred bytes at
  // a time only reaches two thirds of the memory bandwidth. There must still be enough tasks for all threads.
  static constexpr int kMaxTilesPerTask = 8, kTasksPerThread = 8;

  // Returns true if this is the only round and there is no post step, so that constant colors can be written directly to the images.
  bool is_alone() const { return trace_ == nullptr && round_.first && round_.last && attachments_.post.kernel == nullptr; }

  // Fills all rows of tiles with a constant color. This is faster than filling them tile by tile. Returns the remaining rows.
  std::vector<int> fill_constant_rows(const Workers& workers, PassStatistics& statistics) const {
    std::vector<PassStatistics> by_row(static_cast<std::size_t>(context_.tiles_y));
    std::vector<uint8_t> filled(by_row.size());
    workers.for_each(context_.tiles_y, [&](int y) {
      const auto row = static_cast<std::size_t>(y);
      const ConstantTiles tiles = constant_tiles(context_, attachments_, 0, context_.tiles_x, y, by_row[row]);
      filled[row] = tiles.are_constant;
      if (tiles.are_constant) fill_images(attachments_, {tile_pixels(context_, 0, context_.tiles_x, y), tiles.draw});
      finish_stores();
    });
    std::vector<int> rest;
    for (int y = 0; y < context_.tiles_y; ++y) {
      const auto row = static_cast<std::size_t>(y);
      if (filled[row] != 0) {
        statistics += by_row[row];
      } else {
        rest.push_back(y);
      }
    }
    return rest;
  }

  // Processes tiles [tile_x0, tile_x1) of a row.
  void run_strip(int tile_x0, int tile_x1, int tile_y, PassStatistics& statistics) const {
    const TileMemoryLease memory;
    const std::unique_ptr<TileTrace> trace = trace_ != nullptr ? std::make_unique<TileTrace>() : nullptr;
    const bool alone = is_alone();
    ConstantArea area{};  // area of the preceding tiles that is not filled yet
    for (int x = tile_x0; x < tile_x1; ++x) {
      const auto [is_constant, draw] = alone ? constant_tiles(context_, attachments_, x, x + 1, tile_y, statistics) : ConstantTiles{};
      const PixelBounds pixels = tile_pixels(context_, x, x + 1, tile_y);
      if (is_constant && !area.pixels.empty() && area.draw == draw) {
        area.pixels.x1 = pixels.x1;
        continue;
      }
      fill_images(attachments_, area);
      area = is_constant ? ConstantArea{pixels, draw} : ConstantArea{};
      // If this is the only round, a tile without geometry has a constant color and does not get here.
      if (!is_constant) run_measured_tile(x, tile_y, alone || is_drawn(x, tile_y), *memory, statistics, trace.get());
    }
    fill_images(attachments_, area);
    finish_stores();
  }

  bool is_drawn(int tile_x, int tile_y) const {
    return std::any_of(context_.chunks.begin(), context_.chunks.end(), [&](const Chunk& c) { return !bin_of(c, tile_x, tile_y).empty(); });
  }

  void finish_trace(const Tile& tile, int tile_x, int tile_y, TileTrace& trace) const {
    const auto index = static_cast<std::size_t>(tile_y * context_.tiles_x + tile_x);
    trace.finish(tile, static_cast<uint16_t>(trace_->rounds.size() - 1), trace_->rounds.back()[index]);
    if (round_.last) record_values(tile, *trace_);
  }

  void run_measured_tile(int tile_x, int tile_y, bool drawn, TileMemory& memory, PassStatistics& statistics, TileTrace* trace) const {
    if (ms_.empty()) return run_tile(tile_x, tile_y, drawn, memory, statistics, trace);
    const auto start = std::chrono::steady_clock::now();
    run_tile(tile_x, tile_y, drawn, memory, statistics, trace);
    const std::chrono::duration<float, std::milli> time = std::chrono::steady_clock::now() - start;
    ms_[static_cast<std::size_t>(tile_y * context_.tiles_x + tile_x)] += time.count();
  }

  void run_tile(int tile_x, int tile_y, bool drawn, TileMemory& memory, PassStatistics& statistics, TileTrace* trace) const {
    if (drawn) ++statistics.tiles_touched;
    const std::vector<ColorTarget>& colors = attachments_.colors;
    // If nothing is drawn in a tile, its attachments are stored only if they are cleared or if the first of several rounds fills the
    // spill buffer. Otherwise they already have the correct contents; with LoadOp::dont_care, the tile does not even contain them. With
    // several rounds, multisampled attachments are always stored, because they are kept in the spill buffer.
    const bool spills = context_.samples > 1 && !(round_.first && round_.last);
    const auto changes = [&](const auto& target) {
      const bool fills_spill = !round_.last && !keeps_in_image(context_, target);
      return drawn || spills || (round_.first && (clears(target) || fills_spill) && bytes_per_pixel(target.format) != 0);
    };
    const bool changes_color = std::any_of(colors.begin(), colors.end(), changes), changes_depth = changes(attachments_.depth);
    const bool has_post_step = round_.last && attachments_.post.kernel != nullptr;
    if (!changes_color && !changes_depth && !has_post_step) return;

    Tile& tile = memory.tile;
    place_tile(tile, tile_x, tile_y);
    load(tile, replaces_color(tile_x, tile_y));
    if (drawn) draw_tile(context_, attachments_.has_color, tile_x, tile_y, memory, statistics, trace);
    if (trace != nullptr) finish_trace(tile, tile_x, tile_y, *trace);
    store(tile, changes_color, changes_depth);
    // The colors are not resolved if their image stores all samples.
    if (round_.last && !colors.empty() && colors[0].samples > 1 && (trace != nullptr || has_post_step)) resolve_color(tile, tile.color[0]);
    if (trace != nullptr && round_.last) record_resolved(tile, *trace_);
    if (has_post_step) run_post_step(attachments_.post, tile, memory.post_color);
  }

  void place_tile(Tile& tile, int tile_x, int tile_y) const {
    const PixelBounds pixels = tile_pixels(context_, tile_x, tile_x + 1, tile_y);
    tile.size = context_.tile_size;
    tile.samples = context_.samples;
    tile.color_count = static_cast<int>(attachments_.colors.size());
    tile.x0 = pixels.x0;
    tile.y0 = pixels.y0;
    tile.width = pixels.x1 - pixels.x0;
    tile.height = pixels.y1 - pixels.y0;
  }

  // Returns true if the only triangle of a tile replaces the colors of all its pixels.
  bool replaces_color(int tile_x, int tile_y) const {
    if (attachments_.depth.format != DepthFormat::none || context_.samples != 1) return false;
    const Triangle* only = nullptr;
    const Draw* draw = nullptr;
    for (const Chunk& c : context_.chunks) {
      const std::span<const uint16_t> bin = bin_of(c, tile_x, tile_y);
      if (bin.empty()) continue;
      if (bin.size() > 1 || only != nullptr) return false;
      only = &c.triangles[bin[0]];
      draw = &context_.draws[c.ranges[only->range()].draw];
    }
    if (only == nullptr || !draw->deferred || draw->kernels.visibility != nullptr || !only->is_triangle()) return false;
    const PixelBounds pixels = tile_pixels(context_, tile_x, tile_x + 1, tile_y);
    return intersect(pixels, draw->bounds) == pixels && covers(*only, pixels);
  }

  // Loads the attachments of a tile, or only the format of its colors if they are replaced.
  void load(Tile& tile, bool replaces_color) const {
    for (std::size_t i = 0; i < attachments_.colors.size(); ++i) {
      const ColorTarget& c = attachments_.colors[i];
      if (replaces_color) {
        tile.color[i].format = c.format;
      } else if (round_.first) {
        load_color(c, tile, tile.color[i]);
      } else {
        load_color(between_flushes(context_, c, attachments_.color_spills[i]), tile, tile.color[i]);
      }
    }
    if (round_.first) load_depth(attachments_.depth, tile);
    if (!round_.first) load_depth(between_flushes(context_, attachments_.depth, attachments_.depth_spill), tile);
  }

  void store(Tile& tile, bool changes_color, bool changes_depth) const {
    for (std::size_t i = 0; changes_color && i < attachments_.colors.size(); ++i) {
      const ColorTarget& c = attachments_.colors[i];
      if (round_.last) {
        if (c.samples == 1) resolve_color(tile, tile.color[i]);
        store_color(c, tile, tile.color[i]);
      } else {
        store_color(between_flushes(context_, c, attachments_.color_spills[i]), tile, tile.color[i]);
      }
    }
    if (!changes_depth) return;
    if (round_.last) store_depth(attachments_.depth, tile);
    if (!round_.last) store_depth(between_flushes(context_, attachments_.depth, attachments_.depth_spill), tile);
  }

  const PassContext& context_;
  const Attachments& attachments_;
  Round round_;
  PassTrace* trace_;
  std::span<float> ms_;
};

}  // namespace

void keep_between_flushes(const PassContext& context, Attachments& attachments) {
  const std::size_t samples =
      static_cast<std::size_t>(context.width) * static_cast<std::size_t>(context.height) * static_cast<std::size_t>(context.samples);
  const auto spill = [&](const auto& target, std::vector<std::byte>& bytes) {
    if (!keeps_in_image(context, target)) bytes.resize(samples * static_cast<std::size_t>(bytes_per_pixel(target.format)));
  };
  attachments.color_spills.resize(attachments.colors.size());
  for (std::size_t i = 0; i < attachments.colors.size(); ++i) spill(attachments.colors[i], attachments.color_spills[i]);
  spill(attachments.depth, attachments.depth_spill);
}

void run_tiles(const PassContext& context, const Attachments& attachments, Round round, const Workers& workers, PassStatistics& statistics,
               const TileRecords& records) {
  if (records.trace != nullptr) records.trace->rounds.emplace_back(static_cast<std::size_t>(context.tiles_x * context.tiles_y));
  TileWorker(context, attachments, round, records).run(workers, statistics);
}

void run_single_tile(const PassContext& context, const Attachments& attachments, int tile_x, int tile_y, PassStatistics& statistics) {
  TileWorker(context, attachments, {.first = true, .last = true}, {}).run_one(tile_x, tile_y, statistics);
}

}  // namespace halfspace::HS_LANES
