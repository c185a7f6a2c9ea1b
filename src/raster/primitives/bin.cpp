// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/bin.h"

#include <algorithm>
#include <bit>

#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/line.h"
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/triangle_lanes.h"

namespace halfspace::HS_LANES {

namespace {

// List of (tile, triangle) pairs, ordered by triangle, stored as runs: of consecutive triangles, which are usually in the same tile, or of
// the tiles of a large triangle in a row.
class TileRuns {
 public:
  explicit TileRuns(std::size_t triangles) { values_.reserve(triangles + triangles / 2); }

  void put(int tile_x, int tile_y, uint16_t triangle) {
    if (runs_.empty() || runs_.back().tile_x != tile_x || runs_.back().tile_y != tile_y) start_run(tile_x, tile_y);
    values_.push_back(triangle);
  }
  // Adds the tiles [x0, x1) of a row.
  void put_row(int x0, int x1, int tile_y, uint16_t triangle) {
    if (x1 - x0 < 2) {
      if (x0 < x1) put(x0, tile_y, triangle);
      return;
    }
    start_run(x0 | kRow, tile_y);
    values_.push_back(triangle);
    values_.push_back(static_cast<uint16_t>(x1));
    more_ += static_cast<std::size_t>(x1 - x0 - 2);
  }
  // Number of pairs.
  std::size_t size() const { return values_.size() + more_; }
  // Calls f(tile_x, tile_y, triangles) for each tile of each run.
  template <class F>
  void for_each(const F& f) const {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const Run& run = runs_[i];
      if ((run.tile_x & kRow) != 0) {
        for (int x = run.tile_x & ~kRow; x < values_[run.first + 1]; ++x) f(x, run.tile_y, std::span(values_).subspan(run.first, 1));
        continue;
      }
      const std::size_t end = i + 1 < runs_.size() ? runs_[i + 1].first : values_.size();
      f(run.tile_x, run.tile_y, std::span(values_).subspan(run.first, end - run.first));
    }
  }

 private:
  static constexpr int kRow = 0x8000;  // in tile_x: the run is a row of tiles, and has two values, the triangle and the end of the row

  struct Run {
    uint16_t tile_x, tile_y;
    uint32_t first;  // index into values_
  };

  void start_run(int tile_x, int tile_y) {
    runs_.push_back({static_cast<uint16_t>(tile_x), static_cast<uint16_t>(tile_y), static_cast<uint32_t>(values_.size())});
  }

  std::vector<Run> runs_;
  std::vector<uint16_t> values_;
  std::size_t more_ = 0;  // pairs minus values
};

// Returns the half-open range of tiles that contains the pixels. T: PixelBounds, or a PixelBox with one box per lane.
template <class T>
T tiles_of(const PassContext& context, const T& pixels) {
  const int shift = std::countr_zero(static_cast<unsigned>(context.tile_size));
  return {pixels.x0 >> shift, pixels.y0 >> shift, ((pixels.x1 - 1) >> shift) + 1, ((pixels.y1 - 1) >> shift) + 1};
}

// Tile ranges of W triangles.
struct TileRows {
  alignas(64) std::array<int32_t, kLanes> x0, y0, x1, y1;
};

// Returns the tile ranges of `count` triangles of one draw, starting with `first`. The results are invalid for lines and
// smooth triangles.
TileRows tile_rows(const PassContext& context, const Draw& draw, const Triangle* first, std::size_t count) {
  const auto [x, y] = load_corners([&](int k) { return first + std::min(static_cast<std::size_t>(k), count - 1); });
  const PixelBox<Int> tiles = tiles_of(context, intersect(pixel_box(x, y, context.samples_at, context.samples_at), draw.bounds));
  TileRows rows;
  store(rows.x0.data(), tiles.x0);
  store(rows.y0.data(), tiles.y0);
  store(rows.x1.data(), tiles.x1);
  store(rows.y1.data(), tiles.y1);
  return rows;
}

// Returns the maximum of E over the bounding box of a tile's samples.
int64_t max_in_tile(const Edge& e, int tile_x, int tile_y, int size, const SampleSpan& span) {
  const int px = tile_x * size + (e.ey < 0 ? size - 1 : 0);
  const int py = tile_y * size + (e.ex > 0 ? size - 1 : 0);
  const int x = e.ey < 0 ? span.high : span.low, y = e.ex > 0 ? span.high : span.low;
  return e.at(int64_t{px} * kSubPixels + x, int64_t{py} * kSubPixels + y);
}

// An edge of a primitive, as far as it decides about tiles.
struct TileEdge {
  Edge edge;
  int64_t threshold;  // a tile is on the inner side if the maximum of E in it is at least this
};

// Lists the tiles that are on the inner side of all edges. In a row, they are consecutive, because each edge excludes either the first
// tiles or the last ones.
template <std::size_t n>
void list_tiles_inside(const PassContext& context, const std::array<TileEdge, n>& edges, const PixelBounds& tiles, uint16_t index,
                       TileRuns& runs) {
  const int size = context.tile_size;
  std::array<int64_t, n> step;  // of E from one tile to the next
  for (std::size_t i = 0; i < n; ++i) step[i] = edges[i].edge.at(int64_t{size} * kSubPixels, 0) - edges[i].edge.at(0, 0);
  for (int y = tiles.y0; y < tiles.y1; ++y) {
    std::array<int64_t, n> above;  // the threshold, in the next tile
    for (std::size_t i = 0; i < n; ++i) above[i] = max_in_tile(edges[i].edge, tiles.x0, y, size, context.samples_at) - edges[i].threshold;
    const auto is_inside = [&] { return std::ranges::all_of(above, [](int64_t e) { return e >= 0; }); };
    const auto advance = [&](int& x) {
      for (std::size_t i = 0; i < n; ++i) above[i] += step[i];
      ++x;
    };
    int x = tiles.x0;
    while (x < tiles.x1 && !is_inside()) advance(x);
    const int first = x;
    while (x < tiles.x1 && is_inside()) advance(x);
    runs.put_row(first, x, y, index);
  }
}

void list_tiles(const PassContext& context, const Triangle& t, const PixelBounds& tiles, uint16_t index, TileRuns& runs) {
  // The bounding box is accurate enough if it is only one tile wide or high.
  if (tiles.x1 - tiles.x0 == 1 || tiles.y1 - tiles.y0 == 1 || t.is_point()) {
    for (int y = tiles.y0; y < tiles.y1; ++y) runs.put_row(tiles.x0, tiles.x1, y, index);
    return;
  }
  std::array<TileEdge, 3> edges;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge e = edge_of(t, i);
    edges[i] = {e, fill_bias(e)};
  }
  list_tiles_inside(context, edges, tiles, index, runs);
}

void list_line_tiles(const PassContext& context, const Triangle& t, int pixels, const PixelBounds& tiles, uint16_t index, TileRuns& runs) {
  const std::array<BandEdge, 2> band = band_edges(t, pixels);
  const std::array<TileEdge, 2> edges{{{band[0].edge, band[0].bias - band[0].offset}, {band[1].edge, band[1].bias - band[1].offset}}};
  list_tiles_inside(context, edges, tiles, index, runs);
}

}  // namespace

void bin_chunk(const PassContext& context, Chunk& chunk) {
  TileRuns runs(chunk.triangles.size());
  int x0 = context.tiles_x, y0 = context.tiles_y, x1 = 0, y1 = 0;
  for (std::size_t s = 0; s < chunk.ranges.size(); ++s) {
    const Draw& draw = context.draws[chunk.ranges[s].draw];
    const bool is_smooth = draw.is_smooth;
    const std::size_t end = chunk.end_triangle(s);
    for (std::size_t first = chunk.ranges[s].first_triangle; first < end; first += kLanes) {
      const std::size_t count = std::min<std::size_t>(kLanes, end - first);
      const TileRows rows = tile_rows(context, draw, &chunk.triangles[first], count);
      for (std::size_t i = 0; i < count; ++i) {
        const Triangle& t = chunk.triangles[first + i];
        const auto index = static_cast<uint16_t>(first + i);
        PixelBounds tiles{rows.x0[i], rows.y0[i], rows.x1[i], rows.y1[i]};
        if (t.is_line() || is_smooth) tiles = tiles_of(context, pixel_bounds(draw, t, draw.bounds, context.samples_at));
        if (is_smooth) {
          for (int y = tiles.y0; y < tiles.y1; ++y) runs.put_row(tiles.x0, tiles.x1, y, index);
        } else if (t.is_line()) {
          list_line_tiles(context, t, line_pixels(draw.state.line_width), tiles, index, runs);
        } else if (tiles.x1 - tiles.x0 == 1 && tiles.y1 - tiles.y0 == 1) {
          runs.put(tiles.x0, tiles.y0, index);
        } else {
          list_tiles(context, t, tiles, index, runs);
        }
        x0 = std::min(x0, tiles.x0);
        y0 = std::min(y0, tiles.y0);
        x1 = std::max(x1, tiles.x1);
        y1 = std::max(y1, tiles.y1);
      }
    }
  }
  chunk.statistics.bin_entries = runs.size();
  chunk.tile_x0 = x0;
  chunk.tile_y0 = y0;
  chunk.tile_x1 = x1;
  chunk.tile_y1 = y1;
  if (runs.size() == 0) return;

  const auto width = static_cast<std::size_t>(x1 - x0);
  const auto tile_of = [&](int x, int y) { return static_cast<std::size_t>(y - y0) * width + static_cast<std::size_t>(x - x0); };
  chunk.bin_start.assign(width * static_cast<std::size_t>(y1 - y0) + 1, 0);
  runs.for_each(
      [&](int x, int y, std::span<const uint16_t> run) { chunk.bin_start[tile_of(x, y) + 1] += static_cast<uint32_t>(run.size()); });
  for (std::size_t i = 1; i < chunk.bin_start.size(); ++i) chunk.bin_start[i] += chunk.bin_start[i - 1];
  chunk.bin_triangles.resize(runs.size());
  std::vector<uint32_t> next(chunk.bin_start.begin(), chunk.bin_start.end() - 1);
  runs.for_each([&](int x, int y, std::span<const uint16_t> run) {
    uint32_t& to = next[tile_of(x, y)];
    if (run.size() == 1) {
      chunk.bin_triangles[to] = run[0];
    } else {
      std::copy(run.begin(), run.end(), chunk.bin_triangles.begin() + to);
    }
    to += static_cast<uint32_t>(run.size());
  });
}

std::span<const uint16_t> bin_of(const Chunk& chunk, int tile_x, int tile_y) {
  if (chunk.bin_start.empty() || tile_x < chunk.tile_x0 || tile_x >= chunk.tile_x1 || tile_y < chunk.tile_y0 || tile_y >= chunk.tile_y1) {
    return {};
  }
  const auto tile = static_cast<std::size_t>((tile_y - chunk.tile_y0) * (chunk.tile_x1 - chunk.tile_x0) + (tile_x - chunk.tile_x0));
  return std::span(chunk.bin_triangles).subspan(chunk.bin_start[tile], chunk.bin_start[tile + 1] - chunk.bin_start[tile]);
}

}  // namespace halfspace::HS_LANES
