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

// List of (tile, triangle) pairs, ordered by triangle. Consecutive triangles are usually in the same tile, so the list is stored as runs of
// triangles with the same tile.
class TileRuns {
 public:
  explicit TileRuns(std::size_t triangles) { triangles_.reserve(triangles + triangles / 2); }

  void put(int tile_x, int tile_y, uint16_t triangle) {
    if (runs_.empty() || runs_.back().tile_x != tile_x || runs_.back().tile_y != tile_y) {
      runs_.push_back({static_cast<uint16_t>(tile_x), static_cast<uint16_t>(tile_y), static_cast<uint32_t>(triangles_.size())});
    }
    triangles_.push_back(triangle);
  }
  std::size_t size() const { return triangles_.size(); }
  // Calls f(tile_x, tile_y, triangles) for each run.
  template <class F>
  void for_each(const F& f) const {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const std::size_t end = i + 1 < runs_.size() ? runs_[i + 1].first : triangles_.size();
      f(runs_[i].tile_x, runs_[i].tile_y, std::span(triangles_).subspan(runs_[i].first, end - runs_[i].first));
    }
  }

 private:
  struct Run {
    uint16_t tile_x, tile_y;
    uint32_t first;  // index into triangles_
  };
  std::vector<Run> runs_;
  std::vector<uint16_t> triangles_;
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

// Returns the tile ranges of `count` triangles of one draw, starting with `first`. The results are invalid for lines.
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

void list_tiles(const PassContext& context, const Triangle& t, const PixelBounds& tiles, uint16_t index, TileRuns& runs) {
  const int size = context.tile_size;
  const bool one_row = tiles.x1 - tiles.x0 == 1 || tiles.y1 - tiles.y0 == 1 || t.is_point();
  const std::array<Edge, 3> edges{edge_of(t, 0), edge_of(t, 1), edge_of(t, 2)};
  for (int y = tiles.y0; y < tiles.y1; ++y) {
    for (int x = tiles.x0; x < tiles.x1; ++x) {
      // The bounding box is accurate enough if it is only one tile wide or high.
      const auto inside = [&](const Edge& e) { return max_in_tile(e, x, y, size, context.samples_at) - fill_bias(e) >= 0; };
      if (!one_row && !(inside(edges[0]) && inside(edges[1]) && inside(edges[2]))) continue;
      runs.put(x, y, index);
    }
  }
}

void list_line_tiles(const PassContext& context, const Triangle& t, int pixels, const PixelBounds& tiles, uint16_t index, TileRuns& runs) {
  const int size = context.tile_size;
  const std::array<BandEdge, 2> band = band_edges(t, pixels);
  for (int y = tiles.y0; y < tiles.y1; ++y) {
    for (int x = tiles.x0; x < tiles.x1; ++x) {
      const auto inside = [&](const BandEdge& e) { return max_in_tile(e.edge, x, y, size, context.samples_at) + e.offset - e.bias >= 0; };
      if (inside(band[0]) && inside(band[1])) runs.put(x, y, index);
    }
  }
}

}  // namespace

void bin_chunk(const PassContext& context, Chunk& chunk) {
  TileRuns runs(chunk.triangles.size());
  int x0 = context.tiles_x, y0 = context.tiles_y, x1 = 0, y1 = 0;
  for (std::size_t s = 0; s < chunk.ranges.size(); ++s) {
    const Draw& draw = context.draws[chunk.ranges[s].draw];
    const std::size_t end = chunk.end_triangle(s);
    for (std::size_t first = chunk.ranges[s].first_triangle; first < end; first += kLanes) {
      const std::size_t count = std::min<std::size_t>(kLanes, end - first);
      const TileRows rows = tile_rows(context, draw, &chunk.triangles[first], count);
      for (std::size_t i = 0; i < count; ++i) {
        const Triangle& t = chunk.triangles[first + i];
        const auto index = static_cast<uint16_t>(first + i);
        PixelBounds tiles{rows.x0[i], rows.y0[i], rows.x1[i], rows.y1[i]};
        if (t.is_line()) {
          tiles = tiles_of(context, pixel_bounds(draw, t, draw.bounds, context.samples_at));
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
    std::copy(run.begin(), run.end(), chunk.bin_triangles.begin() + to);
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
