// SPDX-License-Identifier: Apache-2.0
//
// Visibility of plain draws, which most are: one sample a pixel, and only coverage and depth decide. The same results as
// visibility.cpp's, with what those draws do not need left out; small triangles in int32 and without blocks.
#include <algorithm>
#include <bit>

#include "raster/block_edges.h"
#include "raster/compare.h"
#include "raster/pixel_box.h"
#include "raster/primitive_setup.h"
#include "raster/sample_cover.h"
#include "raster/visibility.h"

namespace halfspace {

namespace {

// The pixel (x, y) of a tile is kPixelAt.column[x] + kPixelAt.row[y].
struct PixelPlaces {
  std::array<uint16_t, kMaxTileSize> column, row;
};
constexpr PixelPlaces make_pixel_places() {
  PixelPlaces at{};
  for (int i = 0; i < kPixelsPerBlock; ++i) {
    for (int block = 0; block < kBlocksPerRow; ++block) {
      const auto x = static_cast<std::size_t>(block * kBlockSize + block_x(i)),
                 y = static_cast<std::size_t>(block * kBlockSize + block_y(i));
      if (block_y(i) == 0) at.column[x] = static_cast<uint16_t>(block * kPixelsPerBlock + i);
      if (block_x(i) == 0) at.row[y] = static_cast<uint16_t>(block * kBlocksPerRow * kPixelsPerBlock + i);
    }
  }
  return at;
}
constexpr PixelPlaces kPixelAt = make_pixel_places();

// What one triangle's packets do to the tile.
class Writer {
 public:
  Writer(const DrawInTile& d, TriangleId id, PassStatistics& statistics)
      : tile_(d.tile),
        id_(std::bit_cast<int32_t>(id)),
        statistics_(statistics),
        compare_(d.draw.state.depth.compare),
        tests_(d.tests),
        writes_depth_(d.tests && d.draw.state.depth.write),
        writes_id_(d.mode == VisibilityMode::deferred) {}

  bool tests() const { return tests_; }
  bool writes_depth() const { return writes_depth_; }
  CompareOp compare_op() const { return compare_; }

  // Covered lanes of a packet at the depths z_at(), asked for where there is a test; true if one passed.
  template <class Z>
  HS_INLINE bool write(int packet, Mask covered, const Z& z_at) {
    statistics_.samples_tested += static_cast<uint64_t>(std::popcount(bits(covered)));
    float* depth = &tile_.depth[static_cast<std::size_t>(packet) * kLanes];
    Mask mask = covered;
    if (tests_) {
      const Real old = load<Real>(depth), z = z_at();
      mask = mask & compare(compare_, z, old);
      if (writes_depth_) store(depth, select(mask, z, old));
    }
    const uint32_t passed = bits(mask);
    statistics_.samples_passed += static_cast<uint64_t>(std::popcount(passed));
    if (writes_id_ && passed != 0) {
      TriangleId* ids = &tile_.id[static_cast<std::size_t>(packet) * kLanes];
      store(ids, select(mask, Int(id_), load<Int>(ids)));
    }
    return passed != 0;
  }

  // One covered pixel of the tile; keeps the block's bounds true.
  HS_INLINE void write_pixel(int x, int y, float z) {
    const auto pixel = static_cast<std::size_t>(kPixelAt.column[static_cast<std::size_t>(x)] + kPixelAt.row[static_cast<std::size_t>(y)]);
    ++statistics_.samples_tested;
    if (tests_ && !compare(compare_, z, tile_.depth[pixel])) return;
    ++statistics_.samples_passed;
    if (writes_id_) tile_.id[pixel] = static_cast<TriangleId>(id_);
    if (!writes_depth_) return;
    tile_.depth[pixel] = z;
    widen_block_bounds(compare_, tile_, static_cast<int>(pixel / kPixelsPerBlock), z, z);
  }

  // A packet that is covered wholly and passes wholly.
  template <class Z>
  HS_INLINE void write_whole(int packet, const Z& z_at) {
    statistics_.samples_tested += kLanes;
    statistics_.samples_passed += kLanes;
    if (writes_depth_) store(&tile_.depth[static_cast<std::size_t>(packet) * kLanes], z_at());
    if (writes_id_) store(&tile_.id[static_cast<std::size_t>(packet) * kLanes], Int(id_));
  }

 private:
  Tile& tile_;
  int32_t id_;
  PassStatistics& statistics_;
  CompareOp compare_;
  bool tests_, writes_depth_, writes_id_;
};

// ---- small triangles ---------------------------------------------------------------------------------------------

// Triangles that span at most so many pixels need no blocks.
constexpr int kSmallSpan = 48;

bool spans_at_most(const Triangle& t, int pixels) {
  return largest(t.x) - least(t.x) <= pixels * kSubPixels && largest(t.y) - least(t.y) <= pixels * kSubPixels;
}

// An edge function of a small triangle: its value at the tile's first sample, and its steps from pixel to pixel.
struct SmallEdge {
  int32_t e, step_x, step_y, bias;
};
SmallEdge small_edge(const std::array<int32_t, 3>& x, const std::array<int32_t, 3>& y, std::size_t i) {
  const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
  const Edge edge{x[a], y[a], x[b] - x[a], y[b] - y[a]};
  const int32_t bias = fill_bias(edge);
  return {edge.ey * edge.x0 - edge.ex * edge.y0 - bias, -edge.ey * kSubPixels, edge.ex * kSubPixels, bias};
}

// Its depth where edges 1 and 2, without their biases, have the values e1 and e2. R: Real or float.
template <class R>
HS_INLINE R small_depth(const DrawInTile& d, const Triangle& t, IntOf<R> e1, IntOf<R> e2) {
  const float z_high = std::clamp(t.z_max, d.draw.depth_low, d.draw.depth_high);
  const R z = fma(to_real<R>(e1), R(t.z_edge1), fma(to_real<R>(e2), R(t.z_edge2), R(t.z0)));
  return depth_value(d.tile.depth_format, clamp(z, R(d.draw.depth_low), R(z_high)));
}

// A triangle whose covered pixels are known from setup.
void rasterize_known(const DrawInTile& d, const Triangle& t, const PixelBounds& box, TriangleId id, PassStatistics& statistics) {
  const std::array<Edge, 2> edges{edge_of(t, 1), edge_of(t, 2)};
  const PixelBounds in_draw = cut(box, d.draw.bounds);
  Writer writer(d, id, statistics);
  for (uint32_t rest = t.covered(); rest != 0; rest &= rest - 1) {
    const int bit = std::countr_zero(rest);
    const int x = in_draw.x0 + bit % kCoverSide, y = in_draw.y0 + bit / kCoverSide;
    if (x < d.bounds.x0 || y < d.bounds.y0 || x >= d.bounds.x1 || y >= d.bounds.y1) continue;
    const int32_t x_sub = x * kSubPixels + kSubPixels / 2, y_sub = y * kSubPixels + kSubPixels / 2;
    // Edge::at in 32 bits, which is enough for a small triangle (and is faster: tiny_1m 1.05x).
    const auto at = [&](const Edge& e) { return e.ex * (y_sub - e.y0) - e.ey * (x_sub - e.x0); };
    const float z = small_depth<float>(d, t, at(edges[0]), at(edges[1]));
    writer.write_pixel(x - d.tile.x0, y - d.tile.y0, z);
  }
}

// A small triangle in one tile.
class SmallTriangle {
 public:
  // box: the pixels whose samples lie in the triangle's box.
  SmallTriangle(const DrawInTile& d, const Triangle& t, const PixelBounds& box, TriangleId id, PassStatistics& statistics)
      : d_(d), t_(t), writer_(d, id, statistics) {
    const Tile& tile = d.tile;
    // Everything from the tile's first sample; the triangle meets the tile and is small, so all fits in 16 bits.
    const int32_t x_first = tile.x0 * kSubPixels + kSubPixels / 2, y_first = tile.y0 * kSubPixels + kSubPixels / 2;
    const std::array<int32_t, 3> x{t.x[0] - x_first, t.x[1] - x_first, t.x[2] - x_first};
    const std::array<int32_t, 3> y{t.y[0] - y_first, t.y[1] - y_first, t.y[2] - y_first};
    const PixelBounds seen = cut(box, d.bounds);
    rect_ = {seen.x0 - tile.x0, seen.y0 - tile.y0, seen.x1 - tile.x0, seen.y1 - tile.y0};
    for (std::size_t i = 0; i < 3; ++i) edge_[i] = small_edge(x, y, i);
    for (std::size_t i = 0; i < 3; ++i) first_[i] = lane_x() * edge_[i].step_x + lane_y() * edge_[i].step_y + edge_[i].e;
    bounds_ = depth_bounds(t, d.draw, tile.depth_format);
  }

  void visit() {
    if (rect_.x0 >= rect_.x1 || rect_.y0 >= rect_.y1) return;
    const int column0 = rect_.x0 / kPacketWidth, column1 = (rect_.x1 - 1) / kPacketWidth;
    const int row0 = rect_.y0 / kPacketHeight, row1 = (rect_.y1 - 1) / kPacketHeight;
    if ((column1 - column0 + 1) * (row1 - row0 + 1) <= kFewPackets || kLanes == 1) {
      list_each(column0, column1, row0, row1);
    } else {
      list_rows(column0, column1, row0, row1);
    }
    for (std::size_t i = 0; i < listed_; ++i) write(list_[i]);
  }

 private:
  static constexpr int kFewPackets = 40;
  static constexpr std::size_t kMostPackets = (kSmallSpan / kPacketWidth + 2) * (kSmallSpan / kPacketHeight + 2);

  // A packet with covered pixels.
  struct Covered {
    int packet;
    uint32_t lanes;
    int32_t e1, e2;  // edges 1 and 2: by how much they differ from the tile's first packet
  };

  void list_each(int column0, int column1, int row0, int row1) {
    std::array<int32_t, 3> right, up, start;
    for (std::size_t i = 0; i < 3; ++i) {
      right[i] = edge_[i].step_x * kPacketWidth;
      up[i] = edge_[i].step_y * kPacketHeight;
      start[i] = right[i] * column0 + up[i] * row0;
    }
    for (int row = row0; row <= row1; ++row) {
      std::array<int32_t, 3> at = start;
      for (int column = column0; column <= column1; ++column) {
        list(at, column, row);
        for (std::size_t i = 0; i < 3; ++i) at[i] += right[i];
      }
      for (std::size_t i = 0; i < 3; ++i) start[i] += up[i];
    }
  }

  // Row by row of packets: W columns at once are asked whether a packet can hold a covered pixel.
  void list_rows(int column0, int column1, int row0, int row1) {
    std::array<Int, 3> best;  // the edges' largest values in the packets of row 0
    for (std::size_t i = 0; i < 3; ++i) {
      const SmallEdge& e = edge_[i];
      const int32_t rise = std::max(0, e.step_x * (kPacketWidth - 1)) + std::max(0, e.step_y * (kPacketHeight - 1));
      best[i] = iota<Int>() * (e.step_x * kPacketWidth) + (e.e + rise);
    }
    const auto step = [&](std::size_t i, int column, int row) {
      return edge_[i].step_x * (column * kPacketWidth) + edge_[i].step_y * (row * kPacketHeight);
    };
    for (int row = row0; row <= row1; ++row) {
      for (int group = column0 / kLanes * kLanes; group <= column1; group += kLanes) {
        const Int column = iota<Int>() + group;
        const Mask reaches =
            ((best[0] + step(0, group, row)) | (best[1] + step(1, group, row)) | (best[2] + step(2, group, row))) >= Int(0);
        const Mask asked = (column >= Int(column0)) & (column <= Int(column1));
        for (uint32_t rest = bits(reaches & asked); rest != 0; rest &= rest - 1) {
          const int c = group + std::countr_zero(rest);
          list({step(0, c, row), step(1, c, row), step(2, c, row)}, c, row);
        }
      }
    }
  }

  // Lists a packet, at whose pixels the edges differ by `at` from the tile's first packet, if it has covered pixels. Whether it has is as
  // good as random, so there is no branch on it: it would often be foretold wrongly. All are listed before any is written.
  HS_INLINE void list(const std::array<int32_t, 3>& at, int column, int row) {
    Mask mask = ((first_[0] + at[0]) | (first_[1] + at[1]) | (first_[2] + at[2])) >= Int(0);
    if (d_.cut) mask = mask & inside(rect_, column * kPacketWidth, row * kPacketHeight);
    const uint32_t lanes = bits(mask);
    list_[listed_] = {packet_at(column * kPacketWidth, row * kPacketHeight), lanes, at[1], at[2]};
    listed_ += lanes != 0 ? 1 : 0;
  }

  HS_INLINE void write(const Covered& c) {
    const auto z_at = [&] { return small_depth<Real>(d_, t_, first_[1] + (c.e1 + edge_[1].bias), first_[2] + (c.e2 + edge_[2].bias)); };
    const bool passed = writer_.write(c.packet, mask_from_bits<Mask>(c.lanes), z_at);
    if (passed && writer_.writes_depth())
      widen_block_bounds(writer_.compare_op(), d_.tile, c.packet / kPacketsPerBlock, bounds_.low, bounds_.high);
  }

  const DrawInTile& d_;
  const Triangle& t_;
  Writer writer_;
  TileRect rect_;
  std::array<SmallEdge, 3> edge_;
  std::array<Int, 3> first_;  // the edges in the tile's first packet
  DepthBounds bounds_;
  std::size_t listed_ = 0;
  std::array<Covered, kMostPackets + 1> list_;  // one beyond may be written
};

// Remembers that every value of a block was replaced by one in [low, high].
void set_block_bounds(Tile& tile, int block, float low, float high) {
  const auto b = static_cast<std::size_t>(block);
  tile.block_min[b] = low;
  tile.block_max[b] = high;
  tile.block_writes[b] = 0;
}

// ---- all others --------------------------------------------------------------------------------------------------

template <bool small>
void rasterize_blocks(const DrawInTile& d, const Triangle& t, const TileEdges& tile_edges, const SampleGrid& grid, const TileRect& rect,
                      TriangleId id, PassStatistics& statistics) {
  Tile& tile = d.tile;
  const DepthPlane<small> plane(t, tile_edges, d.draw, grid, tile.depth_format);
  const BlockEdges edges(tile_edges);
  const auto [low, high] = depth_bounds(t, d.draw, tile.depth_format);
  const bool cut = d.cut || t.is(kSprite | kLine);
  Writer writer(d, id, statistics);
  const bool spans_many = (rect.x1 - rect.x0) * (rect.y1 - rect.y0) >= kMaxTilePixels / 4;
  if (spans_many && writer.tests() && test_tile(writer.compare_op(), tile, low, high) == BlockTest::none_passes) return;
  constexpr int mask_to_block = ~(kBlockSize - 1);
  for (int y = rect.y0 & mask_to_block; y < rect.y1; y += kBlockSize) {
    for (int x = rect.x0 & mask_to_block; x < rect.x1; x += kBlockSize) {
      const BlockCoverage coverage = block_coverage(edges, x, y);
      if (coverage == BlockCoverage::none) continue;
      const int block = y / kBlockSize * kBlocksPerRow + x / kBlockSize;
      const BlockTest test = writer.tests() ? test_block(writer.compare_op(), tile, block, low, high) : BlockTest::all_pass;
      if (test == BlockTest::none_passes) continue;
      const int first = block * kPacketsPerBlock;
      if (coverage == BlockCoverage::whole && test == BlockTest::all_pass && !cut) {
        for (int p = first; p < first + kPacketsPerBlock; ++p)
          writer.write_whole(p, [&] { return plane.at(edges, packet_x(p), packet_y(p)); });
        if (writer.writes_depth()) set_block_bounds(tile, block, low, high);
      } else {
        for (int p = first; p < first + kPacketsPerBlock; ++p) {
          const int px = packet_x(p), py = packet_y(p);
          if (px >= rect.x1 || py >= rect.y1 || px + kPacketWidth <= rect.x0 || py + kPacketHeight <= rect.y0) continue;
          Mask mask = coverage == BlockCoverage::whole ? Mask(true) : edges.inside(px, py);
          if (cut) mask = mask & inside(rect, px, py);
          if (any(mask)) writer.write(p, mask, [&] { return plane.at(edges, px, py); });
        }
        if (writer.writes_depth()) widen_block_bounds(writer.compare_op(), tile, block, low, high);
      }
    }
  }
}

}  // namespace

bool covers_tile(const DrawInTile& d, const Triangle& t) {
  if (t.is(kSmall | kSprite | kLine)) return false;
  const TileEdges edges = tile_edges(d.draw, t, SampleGrid(d.tile, 0), d.tile.size);
  bool whole = !edges.outside;
  for (std::size_t i = 0; i < 3; ++i) whole &= edges.e[i] == 0 && edges.step_x[i] == 0 && edges.step_y[i] == 0;
  return whole;
}

void write_whole_tile(const DrawInTile& d, const Triangle& t, TriangleId id, const DepthBounds& bounds) {
  const SampleGrid grid(d.tile, 0);
  const TileEdges tile_edges{};
  const DepthPlane<false> plane(t, tile_edges, d.draw, grid, d.tile.depth_format);
  const BlockEdges edges(tile_edges);
  PassStatistics counted_before;
  Writer writer(d, id, counted_before);
  for (int p = 0; p < kPackets; ++p) writer.write_whole(p, [&] { return plane.at(edges, packet_x(p), packet_y(p)); });
  if (!writer.writes_depth()) return;
  for (int b = 0; b < kBlocks; ++b) set_block_bounds(d.tile, b, bounds.low, bounds.high);
}

void rasterize_plain(const DrawInTile& d, const Triangle& t, TriangleId id, PassStatistics& statistics) {
  if (t.is(kSmall) && !t.is(kSprite)) {
    const PixelBounds box = pixel_box(t.x, t.y, SampleSpan{}, SampleSpan{});
    if (t.covered() != 0) return rasterize_known(d, t, box, id, statistics);
    if (spans_at_most(t, kSmallSpan)) return SmallTriangle(d, t, box, id, statistics).visit();
  }
  const SampleGrid grid(d.tile, 0);
  const PixelBounds b = pixel_bounds(d.draw, t, d.bounds, grid.position);
  if (b.empty()) return;
  const TileEdges edges = tile_edges(d.draw, t, grid, d.tile.size);
  if (edges.outside) return;
  const TileRect rect{b.x0 - grid.x0, b.y0 - grid.y0, b.x1 - grid.x0, b.y1 - grid.y0};
  if (t.is(kSmall)) {
    rasterize_blocks<true>(d, t, edges, grid, rect, id, statistics);
  } else {
    rasterize_blocks<false>(d, t, edges, grid, rect, id, statistics);
  }
}

}  // namespace halfspace
