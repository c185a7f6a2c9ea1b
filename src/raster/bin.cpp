// SPDX-License-Identifier: Apache-2.0
#include "raster/bin.h"

#include <algorithm>

#include "raster/edge.h"
#include "raster/line.h"
#include "raster/primitive_setup.h"

namespace halfspace {

namespace {

struct Pair {
  uint32_t tile;
  uint16_t triangle;
};

// The largest E in the box of a tile's samples.
int64_t largest(const Edge& e, int tile_x, int tile_y, int size, const SampleSpan& span) {
  const int px = tile_x * size + (e.ey < 0 ? size - 1 : 0);
  const int py = tile_y * size + (e.ex > 0 ? size - 1 : 0);
  const int x = e.ey < 0 ? span.high : span.low, y = e.ex > 0 ? span.high : span.low;
  return e.at(int64_t{px} * kSubPixels + x, int64_t{py} * kSubPixels + y);
}

void list_tiles(const Frame& frame, const Triangle& t, const PixelBounds& b, uint16_t index, std::vector<Pair>& pairs) {
  const int size = frame.tile_size;
  const int x0 = b.x0 / size, x1 = (b.x1 - 1) / size;
  const int y0 = b.y0 / size, y1 = (b.y1 - 1) / size;
  const bool one_row = x0 == x1 || y0 == y1 || t.is(kSprite);
  const std::array<Edge, 3> edges{edge_of(t, 0), edge_of(t, 1), edge_of(t, 2)};
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      // The box of a triangle within one row or column of tiles is near enough.
      const auto inside = [&](const Edge& e) { return largest(e, x, y, size, frame.samples_at) - fill_bias(e) >= 0; };
      if (!one_row && !(inside(edges[0]) && inside(edges[1]) && inside(edges[2]))) continue;
      pairs.push_back({static_cast<uint32_t>(y * frame.tiles_x + x), index});
    }
  }
}

void list_line_tiles(const Frame& frame, const Triangle& t, int pixels, const PixelBounds& b, uint16_t index, std::vector<Pair>& pairs) {
  const int size = frame.tile_size;
  const std::array<BandEdge, 2> band = band_edges(t, pixels);
  for (int y = b.y0 / size; y <= (b.y1 - 1) / size; ++y) {
    for (int x = b.x0 / size; x <= (b.x1 - 1) / size; ++x) {
      const auto inside = [&](const BandEdge& e) { return largest(e.edge, x, y, size, frame.samples_at) + e.offset - e.bias >= 0; };
      if (inside(band[0]) && inside(band[1])) pairs.push_back({static_cast<uint32_t>(y * frame.tiles_x + x), index});
    }
  }
}

}  // namespace

void bin_chunk(const Frame& frame, Chunk& chunk) {
  std::vector<Pair> pairs;
  pairs.reserve(chunk.triangles.size() + chunk.triangles.size() / 2);
  int x0 = frame.tiles_x, y0 = frame.tiles_y, x1 = 0, y1 = 0;
  for (std::size_t i = 0; i < chunk.triangles.size(); ++i) {
    const Triangle& t = chunk.triangles[i];
    const Draw& draw = frame.draws[chunk.segments[t.segment()].draw];
    const PixelBounds b = pixel_bounds(draw, t, draw.bounds, frame.samples_at);
    x0 = std::min(x0, b.x0 / frame.tile_size);
    y0 = std::min(y0, b.y0 / frame.tile_size);
    x1 = std::max(x1, (b.x1 - 1) / frame.tile_size + 1);
    y1 = std::max(y1, (b.y1 - 1) / frame.tile_size + 1);
    if (t.is(kLine)) {
      list_line_tiles(frame, t, line_pixels(draw.state.line_width), b, static_cast<uint16_t>(i), pairs);
    } else {
      list_tiles(frame, t, b, static_cast<uint16_t>(i), pairs);
    }
  }
  chunk.statistics.bin_entries = pairs.size();
  chunk.tile_x0 = x0;
  chunk.tile_y0 = y0;
  chunk.tile_x1 = x1;
  chunk.tile_y1 = y1;
  if (pairs.empty()) return;

  const auto width = static_cast<std::size_t>(x1 - x0);
  const auto local = [&](uint32_t tile) {
    const int x = static_cast<int>(tile) % frame.tiles_x, y = static_cast<int>(tile) / frame.tiles_x;
    return static_cast<std::size_t>(y - y0) * width + static_cast<std::size_t>(x - x0);
  };
  chunk.bin_start.assign(width * static_cast<std::size_t>(y1 - y0) + 1, 0);
  for (Pair& p : pairs) {
    p.tile = static_cast<uint32_t>(local(p.tile));
    ++chunk.bin_start[p.tile + 1];
  }
  for (std::size_t i = 1; i < chunk.bin_start.size(); ++i) chunk.bin_start[i] += chunk.bin_start[i - 1];
  chunk.bin_triangles.resize(pairs.size());
  std::vector<uint32_t> next(chunk.bin_start.begin(), chunk.bin_start.end() - 1);
  for (const Pair& p : pairs) chunk.bin_triangles[next[p.tile]++] = p.triangle;
}

std::span<const uint16_t> bin_of(const Chunk& chunk, int tile_x, int tile_y) {
  if (chunk.bin_start.empty() || tile_x < chunk.tile_x0 || tile_x >= chunk.tile_x1 || tile_y < chunk.tile_y0 || tile_y >= chunk.tile_y1) {
    return {};
  }
  const auto tile = static_cast<std::size_t>((tile_y - chunk.tile_y0) * (chunk.tile_x1 - chunk.tile_x0) + (tile_x - chunk.tile_x0));
  return std::span(chunk.bin_triangles).subspan(chunk.bin_start[tile], chunk.bin_start[tile + 1] - chunk.bin_start[tile]);
}

}  // namespace halfspace
